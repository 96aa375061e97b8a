/// The detectors of coil faults that a study or the [detection] table of a rig file may name: one
/// line per kind, which its file in this folder describes.
#include <fmt/format.h>

#include "core/base/errors.h"
#include "fdd/detectors/coil_detector.h"
#include "fdd/detectors/examined_detector.h"
#include "fdd/detectors/linkage_balance.h"

#define AMBRIG_DETECTORS(DETECTOR) \
  DETECTOR(Paper)                  \
  DETECTOR(PaperEveryPeriod)       \
  DETECTOR(PaperOnline)            \
  DETECTOR(PaperCoupled)           \
  DETECTOR(CurrentError)           \
  DETECTOR(GlrtOfResiduals)        \
  DETECTOR(CusumOfResiduals)       \
  DETECTOR(KalmanOfLinkages)       \
  DETECTOR(Coupled)                \
  DETECTOR(Commissioned)

namespace ambrig {

#define AMBRIG_DECLARE(name) CoilDetectorKind name();
AMBRIG_DETECTORS(AMBRIG_DECLARE)
#undef AMBRIG_DECLARE

std::span<const CoilDetectorKind> CoilDetectorKinds() {
#define AMBRIG_MAKE(name) name(),
  static const CoilDetectorKind all[] = {AMBRIG_DETECTORS(AMBRIG_MAKE)};
#undef AMBRIG_MAKE
  return all;
}

std::unique_ptr<RunDetector> MakeRunDetector(const std::string& kind, const std::string& where,
                                             const RunDetectorSetup& setup) {
  std::string names;
  for (const CoilDetectorKind& k : CoilDetectorKinds()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", k.name);
    if (k.name != kind) continue;
    // The kinds of the list know eight poles, sides or single magnets; any stator has one
    // of its own.
    if (setup.model.coupling == Coupling::kNetwork) return MakeLinkageBalance(setup);
    return k.make_run ? k.make_run(setup) : std::make_unique<ExaminedDetector>(k, setup);
  }
  throw InputError(fmt::format("{} = \"{}\", allowed: {}", where, kind, names));
}

}  // namespace ambrig
