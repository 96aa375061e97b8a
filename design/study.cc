#include "design/study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "campaign/parameter_draw.h"
#include "core/base/fingerprint.h"
#include "core/base/read_file.h"
#include "core/base/toml_checked.h"
#include "core/base/toml_edit.h"
#include "core/math/normal_distribution.h"
#include "design/point.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

constexpr int kFormat = 2;  // of figures and points: raise it when a point means something else
constexpr double kMostPoints = 1e6;

double Whole(const TomlTable& t, const char* key, double fallback, double lo, double hi) {
  const double v = static_cast<double>(t.Integer(key, static_cast<long long>(fallback)));
  if (!(v >= lo && v <= hi)) t.Fail(key, fmt::format("= {}, allowed: {} to {}", v, lo, hi));
  return v;
}

DesignVariable ReadVariable(const TomlTable& t, const DesignCandidate& c) {
  DesignVariable v;
  v.paths = t.Has("paths") ? t.Strings("paths") : std::vector{t.String("path")};
  if (v.paths.empty())
    t.Fail("paths", "= [], allowed: at least one path such as \"controller.kp\"");
  if (t.Has("values") == t.Has("range"))
    t.Fail("range", "allowed: either range = [low, high] or values = [...]");
  v.start = TomlNumberAt(c.rig_text, c.rig_file, v.paths.front());
  if (t.Has("values")) {
    v.values = t.Numbers("values");
    if (v.values.empty() || v.values.size() > 1000) t.Fail("values", "allowed: 1 to 1000 numbers");
    v.low = *std::min_element(v.values.begin(), v.values.end());
    v.high = *std::max_element(v.values.begin(), v.values.end());
  } else {
    const auto range = t.Numbers("range");
    v.logarithmic = t.Choice("scale", "linear", "linear, log") == "log";
    if (range.size() != 2 || !(range[0] < range[1]) || !std::isfinite(range[0]) ||
        !std::isfinite(range[1]))
      t.Fail("range", "allowed: [low, high] with low < high");
    v.low = range[0];
    v.high = range[1];
    if (v.logarithmic && !(v.low > 0))
      t.Fail("range",
             fmt::format("= [{}, {}] with scale = \"log\", allowed: above 0", v.low, v.high));
  }
  t.RejectUnknownKeys();
  return v;
}

DesignCandidate ReadCandidate(const TomlTable& t) {
  DesignCandidate c;
  c.name = t.String("name");
  c.rig_file = ExistingFile(t, "rig");
  c.rig_text = ReadFile(c.rig_file);
  ReadRigText(c.rig_text, c.rig_file);
  for (const TomlTable& v : t.Tables("variable")) c.variables.push_back(ReadVariable(v, c));
  std::size_t listed = 0;
  for (const DesignVariable& v : c.variables) listed += v.values.empty() ? 0 : 1;
  if (listed != 0 && listed != c.variables.size())
    t.Fail("variable", "has ranges and values mixed, allowed: all of one sort");
  // The ends of every range must be a rig.
  for (const bool high : {false, true}) {
    std::vector<double> values;
    for (const DesignVariable& v : c.variables) values.push_back(high ? v.high : v.low);
    try {
      RigOfPoint(c, values);
    } catch (const InputError& e) {
      t.Fail("variable",
             fmt::format("at its {} end makes no rig: {}", high ? "upper" : "lower", e.what()));
    }
  }
  t.RejectUnknownKeys();
  return c;
}

std::string FigureNames() {
  std::string all;
  for (const FigureInfo& f : FigureInfos()) all += (all.empty() ? "" : ", ") + std::string(f.name);
  return all;
}

FigureSpec ReadFigure(const TomlTable& t, const Study& s, bool objective) {
  FigureSpec f;
  f.objective = objective;
  const std::string of = t.Choice("of", "", FigureNames());
  for (const FigureInfo& info : FigureInfos())
    if (info.name == of) f.info = &info;
  std::vector<std::string> names;
  for (const StudyScenario& k : s.scenarios) names.push_back(k.name);
  if (f.info->of_scenario) {
    const std::string wanted = t.String("scenario");
    const auto it = std::find(names.begin(), names.end(), wanted);
    if (it == names.end())
      t.Fail("scenario", fmt::format("= \"{}\", allowed: {}", wanted,
                                     names.empty() ? "a [[scenario]] first"
                                                   : fmt::format("{}", fmt::join(names, ", "))));
    f.scenario = static_cast<std::size_t>(it - names.begin());
    f.name = wanted + ": " + of;
  } else {
    f.name = of;
  }
  if (f.info->kind == FigureKind::kPlaneOrbit) {
    f.plane = t.String("plane");
    for (const DesignCandidate& c : s.candidates) {
      std::vector<std::string> planes;
      for (const ShaftPlane& p : ReadRigText(c.rig_text, c.rig_file).stations)
        planes.push_back(p.name);
      if (std::find(planes.begin(), planes.end(), f.plane) == planes.end())
        t.Fail("plane", fmt::format("= \"{}\", allowed: {}", f.plane,
                                    planes.empty() ? "a disk or station of a beam rotor"
                                                   : fmt::format("{}", fmt::join(planes, ", "))));
    }
    f.name += " of " + f.plane;
  }
  f.name = t.String("name", f.name);
  if (t.Has("at_most"))
    f.at_most = Within(t, "at_most", kRequired, {f.info->unit, -1e15, 1e15, "limit of the figure"});
  if (!objective && !f.at_most)
    t.Fail("at_most", fmt::format("is missing, allowed: a number in {}", f.info->unit));
  t.RejectUnknownKeys();
  return f;
}

void ReadSearch(const TomlTable& root, Study& s) {
  const auto t = root.Table("search");
  if (!t) return;
  s.method = t->Choice("method", "sweep", "sweep, optimise") == "sweep" ? SearchMethod::kSweep
                                                                        : SearchMethod::kOptimise;
  s.seed = static_cast<std::uint64_t>(Whole(*t, "seed", 1, 0, 1e9));
  if (s.method == SearchMethod::kSweep) {
    s.points = static_cast<int>(Whole(*t, "points", 0, 0, kMostPoints));
  } else {
    s.directions = static_cast<int>(Whole(*t, "directions", 4, 1, 1000));
    s.evaluations = static_cast<int>(Whole(*t, "evaluations", 30, 2, 1e5));
  }
  t->RejectUnknownKeys();
  for (const DesignCandidate& c : s.candidates)
    for (const DesignVariable& v : c.variables) {
      if (s.method == SearchMethod::kOptimise && !v.values.empty())
        t->Fail("method", "= \"optimise\", but a variable has values; allowed: ranges");
      if (v.values.empty() && !(v.low <= v.start && v.start <= v.high))
        t->Fail("", fmt::format("candidate {}: {} = {} in the rig file, allowed: inside its range "
                                "[{}, {}], where the search begins",
                                c.name, v.paths.front(), v.start, v.low, v.high));
    }
}

void ReadSpread(const TomlTable& root, Study& s) {
  const auto t = root.Table("spread");
  if (!t) return;
  const auto draws = static_cast<int>(Whole(*t, "draws", 0, 1, 1e4));
  const auto seed = static_cast<std::uint64_t>(Whole(*t, "seed", 1, 0, 1e9));
  const double scale = Within(*t, "scale", 1, {"-", 0, 10, "times the sd"});
  std::size_t most = 0;
  for (const DesignCandidate& c : s.candidates) {
    std::size_t n = 0;
    for (const Tolerance& k : ReadRigText(c.rig_text, c.rig_file).tolerances) n += k.sd > 0 ? 1 : 0;
    most = std::max(most, n);
  }
  if (most == 0) t->Fail("", "nothing to draw: no parameter of the rigs has an sd");
  for (auto& point : LatinHypercube(draws, static_cast<int>(most), seed)) {
    for (double& u : point) u = scale * NormalQuantile(u);
    s.draws.push_back(point);
  }
  t->RejectUnknownKeys();
}

/// The file that a table of the rig names as its contents (a shaft, a state space).
std::string Named(const DesignCandidate& c, const char* table) {
  const auto t = TomlTable::FromText(c.rig_text, c.rig_file).Table(table);
  return t && t->Has("file") ? ReadFile(Beside(c.rig_file, t->String("file"))) : "";
}

std::string Texts(const Study& s) {
  std::string all = ReadFile(s.file);
  for (const DesignCandidate& c : s.candidates)
    all += c.rig_text + Named(c, "rotor") + Named(c, "controller");
  for (const StudyScenario& k : s.scenarios) all += k.text;
  return all;
}

}  // namespace

double DesignVariable::FromUnit(double u) const {
  const double w = std::clamp(u, 0.0, 1.0);
  return std::clamp(logarithmic ? low * std::pow(high / low, w) : low + w * (high - low), low,
                    high);
}

double DesignVariable::ToUnit(double value) const {
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

const std::vector<FigureInfo>& FigureInfos() {
  static const std::vector<FigureInfo> all{
      {FigureKind::kPeakSensitivity, "peak_sensitivity", "-",
       "largest sensitivity of the axes that [controller] has (ISO 14839-3), worst speed", false},
      {FigureKind::kSettlingTime, "settling_time", "s",
       "time constant of the loop's slowest pole, worst speed", false},
      {FigureKind::kNoiseForce, "noise_force", "N",
       "rms force command of those axes due to sensor noise, worst axis and speed", false},
      {FigureKind::kAmplification, "amplification", "-",
       "1/(2 zeta) of the loop's least damped pole up to the highest of the speeds, worst speed",
       false},
      {FigureKind::kOrbit, "orbit", "m",
       "largest distance of the shaft from the centre of a radial bearing", true},
      {FigureKind::kSettledOrbit, "late_orbit", "m", "largest orbit over the last tenth of the run",
       true},
      {FigureKind::kPlaneOrbit, "plane_orbit", "m",
       "largest distance of a disk or station from where it stood at the start (in the record)",
       true},
      {FigureKind::kClearanceUsed, "clearance_used", "-",
       "largest orbit over the auxiliary bearing's clearance", true},
      {FigureKind::kPeakCurrent, "peak_current", "A", "largest coil current", true},
      {FigureKind::kCopperLoss, "copper_loss", "W", "mean over the run, all coils", true},
      {FigureKind::kContact, "contact", "s", "longest contact with an auxiliary bearing", true},
      {FigureKind::kTouchdown, "touchdown", "-",
       "1 when the rotor touched an auxiliary bearing, else 0", true},
      {FigureKind::kDrop, "drop", "-", "1 when the rotor dropped, else 0", true},
      {FigureKind::kDetectionDelay, "detection_delay", "s", "worst delay of a fault's detection",
       true},
  };
  return all;
}

std::vector<std::size_t> Study::Objectives() const {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < figures.size(); ++k)
    if (figures[k].objective) out.push_back(k);
  return out;
}

Study ReadStudy(const std::string& file) {
  const TomlTable root = TomlTable::FromFile(file);
  Study s;
  s.file = file;
  s.name = root.String("name", file);
  for (const TomlTable& t : root.Tables("candidate")) {
    s.candidates.push_back(ReadCandidate(t));
    for (std::size_t k = 0; k + 1 < s.candidates.size(); ++k)
      if (s.candidates[k].name == s.candidates.back().name)
        t.Fail("name", fmt::format("= \"{}\" stands twice", s.candidates[k].name));
  }
  if (s.candidates.empty())
    root.Fail("candidate", "is missing, allowed: [[candidate]] with name and rig");
  for (const TomlTable& t : root.Tables("scenario")) {
    StudyScenario k;
    k.file = ExistingFile(t, "file");
    k.text = ReadFile(k.file);
    k.name = t.String("name");
    t.RejectUnknownKeys();
    for (const DesignCandidate& c : s.candidates)
      ReadScenarioText(k.text, k.file, ReadRigText(c.rig_text, c.rig_file));
    for (const StudyScenario& other : s.scenarios)
      if (other.name == k.name) t.Fail("name", fmt::format("= \"{}\" stands twice", k.name));
    s.scenarios.push_back(k);
  }
  for (const TomlTable& t : root.Tables("objective")) s.figures.push_back(ReadFigure(t, s, true));
  if (s.figures.empty())
    root.Fail("objective", "is missing, allowed: [[objective]] with of = one of " + FigureNames());
  for (const TomlTable& t : root.Tables("limit")) s.figures.push_back(ReadFigure(t, s, false));
  s.speeds = root.Numbers("speeds", {0.0});
  if (s.speeds.empty() || s.speeds.size() > 20)
    root.Fail("speeds", "allowed: 1 to 20 speeds in rad/s");
  for (const double w : s.speeds)
    if (!(std::abs(w) <= 1e5))
      root.Fail("speeds", fmt::format("= {} rad/s, allowed: -1e5 to 1e5", w));
  for (const double error : root.Numbers("frequency_errors", {})) {
    if (!(std::abs(error) <= 0.5))
      root.Fail("frequency_errors", fmt::format("= {}, allowed: -0.5 to 0.5", error));
    if (error != 0) s.frequency_errors.push_back(error);
  }
  if (s.frequency_errors.size() > 20)
    root.Fail("frequency_errors", "allowed: up to 20 shares of the frequency");
  s.fidelity =
      FidelityByName(root.Choice("fidelity", "switching", "switching, averaged, reference"));
  ReadSearch(root, s);
  ReadSpread(root, s);
  root.RejectUnknownKeys();
  s.fingerprint =
      fmt::format("{:016x}", Fingerprint(Texts(s), Fingerprint(std::to_string(kFormat))));
  return s;
}

}  // namespace ambrig
