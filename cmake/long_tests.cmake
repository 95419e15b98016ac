# Read by ctest before it runs: tests that take longer than 10 s of a processor in a release start first,
# so that at the end one processor does not wait for the other. Names that CTest does not have are left
# out, and so are tests added by add_test, which say their cost where they are added.
# What demos make is looked at again by the tests of their pages (cmake/browser_tests.cmake), which take
# long themselves.
foreach(demo DemoProgram.ThePhysicsDecidesAndAPatchThatNobodyWasToldOfBreaksLimitsIsFoundAndIsAvoided
             DemoProgram.WithoutADriveItPlansAlone DemoProgram)
  set_tests_properties(${demo} PROPERTIES COST 100 FIXTURES_SETUP demo
                                          ENVIRONMENT REGOPLAN_DEMO_FOLDER=@CMAKE_BINARY_DIR@/demo)
endforeach()
set_tests_properties(Plan.SearchesUnderEveryDriveLawAndWithWheelsThatRollFreely PROPERTIES COST 30)
set_tests_properties(
  Diagnose.ABiasIsNamedWhereverOnTheBedTheRunsBegan
  Diagnose.AZeroThatSettlesIsASensorAndSaidWhen
  Diagnose.AnAmplifierThatWarmsUpIsASensorAndSaidWhen
  DiagnosisReportInTheBrowser.DrawsEveryVerdictWithoutAnError
  DriveDiagnosisProgram.AHiddenSoftPatchIsFoundAndThePlanGoesOnWithIt
  GeneratedCases.ALackOfFitThatPredictsNothingIsTakenForChance
  GeneratedCases.FaultsThatAreKnownExactlyMustLeaveNoLackOfFit
  Interruption.EndsADiagnosisAgainstAReferenceWithinASecondAtAnyTime
  Interruption.EndsADiagnosisWithinASecondAtAnyTime
  MariasPass.ACuriosityClassRoverDrivesFromOneOfItsStopsToAnother
  SmallestDetectable.AnEffectOfTwiceThatSizeIsDetected
  TorqueSign.IsLeftAsItIsWhereFaultsOfTheVehicleExplainTheTorques
  UntoldDays.AreNoneWhereRoundsOnlyScatter
  VehicleEffects.ASoilFarWeakerThanTheMapSaysIsEstimatedToBearAndToHoldLess
  VehicleEffects.AWeakZoneOfThirtyMetresIsFoundWhereItLiesAndToldBeforeItIsFitted
  VehicleEffects.NothingElseIsClaimedBesideADragWhereTorqueScatters
  VehicleEffects.NothingIsClaimedWhereNothingIsOtherwise
  VehicleEffects.NothingIsClaimedWhereNothingIsOtherwiseAndTorqueScatters
  VehicleEffects.SoilsBesideAZoneAreToldAsSurelyAsTheyAreKnown
  PROPERTIES COST 20)
