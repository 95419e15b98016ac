#include "diagnosis/fit/instrument_fault.h"

#include <cmath>
#include <vector>

namespace regoplan {
namespace {

/// What is there of an instrument's fault at the time of each condition of a channel.
/// \param x the effect's coordinates
Eigen::ArrayXd course_of(const TestBed& bed, const Effect& effect, std::size_t channel,
                         const Eigen::VectorXd& x) {
  const ChannelData& data = bed.channels[channel];
  Eigen::ArrayXd course = Eigen::ArrayXd::Ones(data.mean.size());
  if (effect.course == FaultCourse::kConstant) return course;
  const auto number = [&](const char* name) { return effect.fixed.at(name); };
  for (Eigen::Index i = 0; i < course.size(); ++i) {
    const std::size_t at = data.conditions[static_cast<std::size_t>(i)];
    const double time_s = bed.conditions[at].conditions.time_s;
    if (effect.course == FaultCourse::kForATime) {
      course[i] = time_s >= number("from_s") && time_s <= number("to_s") ? 1 : 0;
      continue;
    }
    const double passed = time_s - number("first_time_s");
    course[i] = effect.course == FaultCourse::kDrifting
                    ? passed / (number("last_time_s") - number("first_time_s"))
                    : std::exp(-passed / effect.coordinates[1].value(x[1]));
  }
  return course;
}

/// Adds a share of one channel to another. Both stand at their conditions; what lacks the other's
/// value stays as it is.
void leak(const TestBed& bed, std::size_t from_channel, std::size_t to_channel, double share,
          Eigen::VectorXd& values) {
  const ChannelData& source = bed.channels[from_channel];
  const ChannelData& sink = bed.channels[to_channel];
  const Eigen::VectorXd from = values.segment(bed.offset(from_channel), source.mean.size());
  auto to = values.segment(bed.offset(to_channel), sink.mean.size());
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < to.size(); ++i) {
    const std::size_t at = sink.conditions[static_cast<std::size_t>(i)];
    while (k < from.size() && source.conditions[static_cast<std::size_t>(k)] < at) ++k;
    if (k < from.size() && source.conditions[static_cast<std::size_t>(k)] == at) {
      to[i] += share * from[k];
    }
  }
}

/// Adds what the model lacks as references tell, or takes it off again.
void add_shared(const TestBed& bed, double times, Eigen::VectorXd& values) {
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const Eigen::VectorXd& shared = bed.channels[c].shared;
    if (shared.size() > 0) values.segment(bed.offset(c), shared.size()) += times * shared;
  }
}

/// \param values of the channels as a sound sensor reads them
void apply(const TestBed& bed, const Effect& effect, const Eigen::VectorXd& x,
           Eigen::VectorXd& values) {
  const double amount = effect.coordinates.front().value(x[0]);
  if (effect.kind == EffectKind::kCrosstalk) {
    leak(bed, effect.from, effect.to, amount, values);
    return;
  }
  if (effect.kind == EffectKind::kTurn) {
    // Three shears are a rotation.
    const double shear = std::tan(amount / 2);
    leak(bed, effect.from, effect.to, shear, values);
    leak(bed, effect.to, effect.from, -std::sin(amount), values);
    leak(bed, effect.from, effect.to, shear, values);
    return;
  }
  std::vector<std::size_t> channels = effect.also;
  channels.push_back(effect.to);
  for (const std::size_t c : channels) {
    auto to = values.segment(bed.offset(c), bed.channels[c].mean.size()).array();
    const Eigen::ArrayXd now = amount * course_of(bed, effect, c, x);
    if (effect.kind == EffectKind::kBias) {
      to += now;
    } else {
      to *= 1 + now;
    }
  }
}

}  // namespace

void apply_fault(const TestBed& bed, const Effect& effect, const Eigen::VectorXd& x,
                 Eigen::VectorXd& values) {
  add_shared(bed, 1, values);
  apply(bed, effect, x, values);
  add_shared(bed, -1, values);
}

}  // namespace regoplan
