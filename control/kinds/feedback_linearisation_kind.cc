/// kind = "feedback-linearisation": a PID whose forces the exact inverse of the magnets
/// turns into currents.
#include "control/kinds/feedback_linearisation.h"

namespace ambrig {

namespace {

void ReadLinearising(const TomlTable& t, const ControllerNames&, ControllerParameters& c) {
  t.Read(c.pid, kPidFields);
}

std::unique_ptr<PositionController> MakeLinearising(const ControllerParameters& c,
                                                    const ControllerSite& site) {
  return std::make_unique<FeedbackLinearisation>(
      std::vector<PidParameters>(site.axes.size(), c.pid), site);
}

}  // namespace

const ControllerKind& FeedbackLinearisationKind() {
  static constexpr ControllerKind kind{
      .name = "feedback-linearisation",
      .doc = "one PID per axis, currents by the magnets' inverse",
      .read = ReadLinearising,
      .make = MakeLinearising,
  };
  return kind;
}

}  // namespace ambrig
