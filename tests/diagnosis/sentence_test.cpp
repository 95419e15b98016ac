#include "diagnosis/findings/sentence.h"

#include <gtest/gtest.h>

namespace regoplan {
namespace {

Diagnosis named() {
  Diagnosis diagnosis{.verdict = Verdict::kNamed, .share_explained = 0.7, .excess_is_clear = true};
  diagnosis.claims = {{.id = "slip_sinkage", .probability = 0.96}};
  diagnosis.where = {{.channel = Channel::kSinkage,
                      .region = {{"slip_ratio", {0.3, 0.8}}},
                      .effect = 0.0042,
                      .ci95 = {0.0035, 0.0049}}};
  return diagnosis;
}

void expect_says(const std::string& sentence, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    EXPECT_NE(sentence.find(word), std::string::npos) << word << " in: " << sentence;
  }
}

TEST(Sentence, OfOtherSoilNumbersSaysWhatWasTakenForChance) {
  Diagnosis diagnosis{.verdict = Verdict::kParameters};
  expect_says(sentence_of(diagnosis), {"no physics is missing that these data could show"});
  diagnosis.support.tests = PlainModel::kDoubted;
  expect_says(sentence_of(diagnosis), {"is taken for chance (see the notes)"});
}

TEST(Sentence, ThatNothingIsMissingSaysWhereItsNoiseIsGuessed) {
  for (const Verdict verdict : {Verdict::kConsistent, Verdict::kParameters}) {
    Diagnosis diagnosis{.verdict = verdict};
    EXPECT_EQ(sentence_of(diagnosis).find("guessed"), std::string::npos);
    diagnosis.guessed_noise = {Channel::kFx, Channel::kSinkage};
    expect_says(sentence_of(diagnosis),
                {"noise, which is guessed from neighbouring conditions for fx_n, sinkage_m"});
  }
}

TEST(Sentence, TellsFormAndFittedNumbersOfANameThatStandsAlone) {
  Diagnosis diagnosis = named();
  Claim& claim = diagnosis.claims.front();
  claim.form = "exponent";
  claim.parameters = {{"n1", {0.31, 0.04}}, {"n2", {0.1, 0.02}}, {"known", {3, 0}}};
  expect_says(sentence_of(diagnosis), {"96 % (exponent: n1 0.31, std 0.04; n2 0.1, std 0.02)."});
  claim.parameters.clear();
  expect_says(sentence_of(diagnosis), {"96 % (exponent)."});
  claim.equivalent = {"grousers"};
  EXPECT_EQ(sentence_of(diagnosis).find("exponent"), std::string::npos);
}

TEST(Sentence, AsksForTheUnitWhoseFactorAGainIs) {
  Diagnosis diagnosis = named();
  diagnosis.claims = {{.id = "sensor_gain", .form = "fx_n", .probability = 0.99}};
  Claim& claim = diagnosis.claims.front();
  claim.parameters = {{"gain", {-0.772, 0.004}}};
  expect_says(sentence_of(diagnosis), {"fx_n: gain -0.772, std 0.004; is it in lbf?"});
  claim.form = "torque_nm";
  claim.parameters = {{"gain", {-0.258, 0.01}}};
  expect_says(sentence_of(diagnosis), {"is it in lbf ft?"});
  for (const Estimate& none : {Estimate{-0.2, 0.01}, Estimate{-0.26, 0.1}}) {
    claim.parameters = {{"gain", none}};
    EXPECT_EQ(sentence_of(diagnosis).find("is it in"), std::string::npos) << none.value;
  }
}

TEST(Sentence, NamesChannelSizeRegionMechanismAndProbability) {
  expect_says(sentence_of(named()),
              {"Sinkage lies 4.2 mm (95 %: 3.5 to 4.9) above the calibrated model at "
               "slip ratio 0.3 to 0.8;",
               "slip_sinkage, 96 %"});
}

TEST(Sentence, SaysBelowOfWhatIsLess) {
  Diagnosis diagnosis = named();
  diagnosis.where.front() = {.channel = Channel::kFy,
                             .region = {{"abs_slip_angle_deg", {16, 16}}, {"load_n", {20, 64}}},
                             .effect = -3,
                             .ci95 = {-3.5, -2.5}};
  expect_says(sentence_of(diagnosis), {"Side force lies 3 N (95 %: 2.5 to 3.5) below",
                                       "slip angle to either side 16 deg, load 20 to 64 N"});
}

TEST(Sentence, CountsALongTimeInMinutesHoursOrDays) {
  Diagnosis diagnosis = named();
  diagnosis.where.front().region = {{"time_s", {1.296e5, 3.456e5}}};
  expect_says(sentence_of(diagnosis), {"at time 1.5 to 4 days;"});
  diagnosis.where.front().region = {{"time_s", {0, 5400}}};
  expect_says(sentence_of(diagnosis), {"at time 0 to 90 min;"});
  diagnosis.where.front().region = {{"time_s", {0, 100}}};
  expect_says(sentence_of(diagnosis), {"at time 0 to 100 s;"});
}

TEST(Sentence, TellsTheEdgesOfATimeApartWhereverTheClockStands) {
  Diagnosis diagnosis = named();
  diagnosis.where.front().region = {{"time_s", {1.700081e9, 1.7001014e9}}};
  expect_says(sentence_of(diagnosis), {"at time 19676.9 to 19677.1 days;"});
}

TEST(Sentence, TellsARangeThatLooksLikeOneNumberAsThatNumber) {
  Diagnosis diagnosis = named();
  diagnosis.where.front().region = {{"load_n", {13.58, 13.62}}};
  expect_says(sentence_of(diagnosis), {"at load 13.6 N;"});
}

TEST(Sentence, TellsAnEndOfARangeAsFinelyAsTheOther) {
  Diagnosis diagnosis = named();
  diagnosis.where.front().region = {{"slip_ratio", {-0.000567, 0.501}}};
  expect_says(sentence_of(diagnosis), {"at slip ratio -0.001 to 0.501;"});
  diagnosis.where.front().region = {{"slip_ratio", {-0.000067, 0.501}}};
  expect_says(sentence_of(diagnosis), {"at slip ratio 0 to 0.501;"});
}

TEST(Sentence, IsNeverQuiteCertain) {
  Diagnosis diagnosis = named();
  diagnosis.claims.front().probability = 0.9999;
  expect_says(sentence_of(diagnosis), {"slip_sinkage, over 99 %"});
}

TEST(Sentence, OfANameThatMayStandInForSomethingElseTheDataDoNotSayThatItIsThere) {
  Diagnosis diagnosis = named();
  diagnosis.claims.front().probability = 0.49;
  const std::string said = sentence_of(diagnosis);
  expect_says(said, {"slip_sinkage, 49 %", "fits best", "something on no list may do it instead"});
  EXPECT_EQ(said.find("the data say"), std::string::npos) << said;
}

TEST(Sentence, SaysWhatANameLeavesUnexplained) {
  expect_says(sentence_of(named()), {"leaves 30 % of the excess misfit on held-out conditions"});
}

TEST(Sentence, LeavesWithoutANameWhatTheSharesLeave) {
  Diagnosis diagnosis = named();
  diagnosis.claims.front().share = Share{.explained = 0.68, .low = 0.6, .high = 0.7};
  diagnosis.remainder_share = 0.32;
  expect_says(sentence_of(diagnosis),
              {"32 % of the excess misfit on held-out conditions has no name"});
  EXPECT_EQ(sentence_of(diagnosis).find("30 %"), std::string::npos);
}

TEST(Sentence, TellsNoShareOfAnExcessThatNoiseMayBe) {
  Diagnosis diagnosis = named();
  diagnosis.excess_is_clear = false;
  const std::string sentence = sentence_of(diagnosis);
  EXPECT_EQ(sentence.find("excess misfit"), std::string::npos) << sentence;
}

TEST(Sentence, BeginsWithACapitalWhereverNothingIsLocated) {
  Diagnosis diagnosis = named();
  diagnosis.where.clear();
  EXPECT_EQ(sentence_of(diagnosis).rfind("The data say", 0), 0) << sentence_of(diagnosis);
}

TEST(Sentence, CountsRunsAsTheRowsOfARecordingDo) {
  Diagnosis diagnosis = named();
  diagnosis.where.front().region = {{"run_order", {31.3, 47}}};
  expect_says(sentence_of(diagnosis), {"at run 33 to 48"});
}

TEST(Sentence, SaysOnWhichDayReplicatesDiffer) {
  Diagnosis diagnosis = named();
  diagnosis.where.front().region = {{"on_day", {2, 2}}};
  expect_says(sentence_of(diagnosis), {"at day 2 of the recording"});
}

TEST(Sentence, DoesNotChargeANameWithWhatARefusedCorrectionLeaves) {
  Diagnosis diagnosis = named();
  diagnosis.share_explained = -0.02;
  diagnosis.correction_refused = true;
  const std::string sentence = sentence_of(diagnosis);
  expect_says(sentence, {"slip_sinkage, 96 %", "the corrected model leaves it out"});
  EXPECT_EQ(sentence.find("remains"), std::string::npos) << sentence;
}

TEST(Sentence, OfAClassNamesAllAndWhatWouldDecide) {
  Diagnosis diagnosis = named();
  diagnosis.verdict = Verdict::kClass;
  diagnosis.claims.front().equivalent = {"grousers"};
  diagnosis.next_experiments = {{.conditions = {{"slip_ratio", 0.9}, {"load_n", 30}}}};
  expect_says(sentence_of(diagnosis), {"slip_sinkage or grousers", "cannot tell the names apart",
                                       "load 30 N, slip ratio 0.9"});
  diagnosis.next_experiments = {{.further_sensor = Channel::kTorque}};
  expect_says(sentence_of(diagnosis), {"Measure torque to decide"});
}

TEST(Sentence, OfAZeroOrADragAsksForTheLiftedWheel) {
  Diagnosis diagnosis = named();
  diagnosis.verdict = Verdict::kClass;
  diagnosis.claims.front() = {.id = "bearing_drag", .equivalent = {"sensor_bias"}};
  expect_says(sentence_of(diagnosis), {"lift the wheel and read its torque at rest and turning"});
}

TEST(Sentence, OfAClaimHoldsWhatWasMeasuredAgainstTheSoilFittedBesideIt) {
  Diagnosis diagnosis = named();
  diagnosis.where_off = WhereOff::kSoilBesideClaim;
  expect_says(sentence_of(diagnosis), {"above the model with its soil fitted beside the claim at"});
}

TEST(Sentence, InPartTellsNoShareAsAllNorAsNothing) {
  Diagnosis diagnosis = named();
  diagnosis.verdict = Verdict::kPartly;
  diagnosis.claims.front().share = Share{.explained = 0.9984, .low = 0.997, .high = 0.9984};
  diagnosis.remainder_share = 0.0016;
  expect_says(sentence_of(diagnosis),
              {"slip_sinkage explains over 99 % of it", "under 1 % has no name"});
}

TEST(Sentence, OfWrongSoilNumbersNamesTheFarthest) {
  Diagnosis diagnosis{.verdict = Verdict::kParameters};
  diagnosis.soil = {
      {.parameter = "n", .prior = {1, 0.05}, .calibrated = {1.1, 0.02}, .pull = 2},
      {.parameter = "kphi", .prior = {8e5, 1e5}, .calibrated = {4.5e5, 4e4}, .pull = -3.5}};
  expect_says(sentence_of(diagnosis),
              {"kphi", "-3.5 prior standard deviations", "no physics is missing"});
}

TEST(Sentence, OfWrongSoilNumbersTellsWhatGainsMoreThanChanceAndIsNotProven) {
  Diagnosis diagnosis{.verdict = Verdict::kParameters};
  diagnosis.soil = {{.parameter = "n", .prior = {1, 0.05}, .calibrated = {1.1, 0.02}, .pull = 2}};
  diagnosis.support.tests = PlainModel::kRefuted;
  diagnosis.suspects = {"shear_hump"};
  expect_says(sentence_of(diagnosis),
              {"proves nothing on held-out conditions", "nearest to a name: shear_hump."});
  diagnosis.soil.front().pull = 3.5;
  expect_says(sentence_of(diagnosis), {"no clean bill: shear_hump would do instead."});
}

TEST(Sentence, OfTheUnexplainedInventsNoName) {
  Diagnosis diagnosis = named();
  diagnosis.verdict = Verdict::kUnexplained;
  diagnosis.claims.clear();
  const std::string sentence = sentence_of(diagnosis);
  expect_says(sentence, {"Sinkage", "no known name explains it"});
  EXPECT_EQ(sentence.find("slip_sinkage"), std::string::npos);
}

TEST(Sentence, OfTheUnexplainedTellsTheNameThatIsNearest) {
  Diagnosis diagnosis = named();
  diagnosis.verdict = Verdict::kUnexplained;
  diagnosis.claims.clear();
  diagnosis.ranking = {{"sensor_bias", 0.48, 20}, {"unexplained", 0.26, 19}};
  expect_says(sentence_of(diagnosis), {"no known name stands (nearest: sensor_bias)"});
  diagnosis.ranking[0].probability = 0.3;
  expect_says(sentence_of(diagnosis), {"no known name explains it"});
  diagnosis.ranking[0].probability = 0.48;
  std::swap(diagnosis.ranking[0], diagnosis.ranking[1]);
  expect_says(sentence_of(diagnosis), {"no known name explains it"});
}

}  // namespace
}  // namespace regoplan
