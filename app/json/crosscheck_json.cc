#include "app/json/crosscheck_json.h"

#include <cmath>

namespace ambrig {

namespace {

using Json = nlohmann::ordered_json;

Json UnlessNegative(double value) { return value < 0 ? Json(nullptr) : Json(value); }

Json FiguresJson(const CrosscheckRun& run) {
  const DropFigures& f = run.figures;
  Json rest = Json::object();
  for (std::size_t b = 0; b < f.rest.size(); ++b) rest[run.paths.bearings[b].bearing] = f.rest[b];
  return {{"verdict", VerdictName(f)},
          {"touchdown", f.touchdown},
          {"drop", f.drop},
          {"first_touched", f.first},
          {"touchdown_time", UnlessNegative(f.touchdown_time)},
          {"first_rebound", f.rebound},
          {"peak_orbit", f.peak_orbit},
          {"whirl", WhirlName(f.whirl)},
          {"whirl_turns", f.turns},
          {"rest", rest},
          {"severity", f.severity},
          {"fall_severity", f.fall_severity}};
}

}  // namespace

std::string VerdictName(const DropFigures& figures) {
  return figures.drop ? "dropped" : figures.touchdown ? "touched down" : "stayed up";
}

nlohmann::ordered_json CrosscheckJson(const CrosscheckedScenario& s) {
  const ContactCrosscheck& w = s.crosscheck;
  Json out = {{"file", s.file},
              {"name", s.name},
              {"seed", s.seed},
              {"contact", w.contact()},
              {"verdicts_agree", w.verdicts_agree()},
              {"whirl_agrees", w.model.figures.whirl == w.ode.figures.whirl},
              {"parted_ode", UnlessNegative(w.parted_ode)},
              {"parted_other_noise", UnlessNegative(w.parted_noise)},
              {"ode_steps", w.ode_steps},
              {"ode_warnings", w.ode_warnings},
              {"compliant", FiguresJson(w.model)},
              {"ode", FiguresJson(w.ode)}};
  if (!w.other_noise.figures.rest.empty()) out["other_noise"] = FiguresJson(w.other_noise);
  return out;
}

}  // namespace ambrig
