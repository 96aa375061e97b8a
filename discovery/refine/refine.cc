#include "discovery/refine/refine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/read_file.h"
#include "core/base/toml_edit.h"
#include "core/record/channels.h"
#include "discovery/case/test_records.h"
#include "discovery/decision/prepared_models.h"
#include "discovery/model/coil_errors.h"
#include "discovery/model/floor.h"
#include "discovery/refine/adopt.h"
#include "discovery/search/likelihood.h"
#include "discovery/shape/named_law.h"
#include "effects/effect.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

/// Makes both models ready. @throws InputError for wrong data
Comparison Prepare(CaseModel& full, CaseModel& thin, const Hypothesis& nominal) {
  Comparison before = PrepareModels(full, thin, nominal);
  for (const DataFault& f : before.data)
    throw InputError(fmt::format("{}: the data are wrong ({}); correct them first",
                                 full.data().file, FaultText(f)));
  return before;
}

/// What the coils of the machine differ by is without doubt beside the shape, if anywhere: law and
/// shape are then fitted once more beside it, and their rigs hold it.
void FitBesideCoilErrors(const CaseModel& thin, const ShapeFitOptions& options, NamedLaw& law,
                         Refinement& out) {
  FitOptions same;
  same.effective_sample_size = options.effective_sample_size;
  FitResult named = Fit(thin, law.fit.hypothesis, same);
  const Hypothesis& found = out.fit.fit.hypothesis;
  Shape start = out.shape;
  start.effect = found.rig.effects.back();
  ShapeFit shaped =
      FitShape(thin, WithoutEffect(found, found.rig.effects.size() - 1), start, options);
  if (!named.converged || !shaped.fit.converged) return;
  law.fit = std::move(named);
  out.fit = std::move(shaped);
  const std::vector<NuisanceFound> found_beside = AmountsOfNuisances(thin, out.fit.fit.predicted);
  for (FitResult* fit : {&law.fit, &out.fit.fit}) AddCoilErrors(found_beside, fit->hypothesis.rig);
}

/// All rows with the floors of the case: residual and the two ratios.
std::vector<double> AllRows(const CaseModel& model, const Hypothesis& h, double* fit,
                            double* unseen) {
  const auto predicted = model.Predict(h);
  if (!predicted) throw InputError(model.data().file + ": the refined model loses levitation");
  std::vector<double> r = Residual(model, *predicted);
  *fit = Ratio(model, r, Which::kFit);
  *unseen = Ratio(model, r, Which::kValidate);
  if (*unseen == 0) *unseen = Ratio(model, r, Which::kAll);
  return r;
}

/// The law that the shape starts from, and the stretch that the fit supports.
void DrawCurve(Refinement& out) {
  const std::vector<double> start = out.shape.Sizes();
  double lo = kInfinity, hi = -kInfinity;  // where the law is driven
  for (std::size_t k = 0; k < out.shape.knots.size(); ++k)
    if (out.fit.influence[k] > 1) {
      lo = std::min(lo, out.shape.knots[k]);
      hi = std::max(hi, out.shape.knots[k]);
    }
  if (!out.shape.everywhere && out.shape.knots.front() == 0) lo = 0;
  for (const double u : out.shape.u) {
    CurvePoint p;
    p.u = u;
    p.value = out.shape.value(out.fit.sizes, u);
    p.sd = out.fit.CurveSd(out.shape, u);
    p.support = out.fit.Support(out.shape, u);
    p.named = out.shape.value(start, u);
    p.visited = out.shape.everywhere || (lo <= u && u <= hi);
    out.curve.push_back(p);
  }
  std::size_t best = 0;
  for (std::size_t k = 0; k < out.curve.size();) {
    std::size_t end = k;
    while (end < out.curve.size() && out.curve[end].visited && out.curve[end].support > kSupported)
      ++end;
    if (end - k > best) {
      best = end - k;
      out.supported_lo = out.curve[k].u;
      out.supported_hi = out.curve[end - 1].u;
    }
    k = std::max(end, k + 1);
  }
}

constexpr double kLeastGain = 20;  // of 2 log likelihood: less is no better than the law
constexpr double kWorse = 1.05;    // of the error over the noise

void Warn(Refinement& out, bool better) {
  if (!better)
    out.warnings.push_back("the free shape explains no more than the catalogue's law: keep that");
  else if (out.any_unseen && out.ratio_after > kWorse * out.ratio_before)
    out.warnings.push_back(
        "unseen records are explained worse than by the catalogue's law: they go beyond the "
        "support, or another effect is missing");
  if (out.supported_hi <= out.supported_lo)
    out.warnings.push_back("no part of the curve is supported by these records");
  const std::vector<double>& in = out.fit.influence;
  const auto idle = std::count_if(in.begin(), in.end(), [](double i) { return i < 1; });
  if (idle > 0)
    out.warnings.push_back(
        fmt::format("{} of {} sizes are not determined by these records", idle, in.size()));
  for (std::size_t k = 0; k < out.fit.fit.hypothesis.free.size(); ++k) {
    const FreeParameter& p = out.fit.fit.hypothesis.free[k];
    const double sds = out.fit.fit.hypothesis.Coordinate(k);
    if (p.sd > 0 && std::abs(sds) > 3)
      out.warnings.push_back(fmt::format("{} moved by {:+.1f} sd", p.path, sds));
  }
}

std::string RigText(const Case& c, const Refinement& r, const std::string& output) {
  std::vector<EffectInstance> effects = r.fit.fit.hypothesis.rig.effects;
  if (effects.back().label.empty())
    effects.back().label = fmt::format("{} refined, supported {:.3g} to {:.3g} {}", r.effect,
                                       r.supported_lo, r.supported_hi, r.shape.u_unit);
  const std::string text = AdoptedRigText(ReadFile(c.rig_file), r.fit.fit.hypothesis, effects);
  namespace fs = std::filesystem;
  const auto folder = [](const std::string& f) {
    return fs::absolute(f).lexically_normal().parent_path();
  };
  return folder(c.rig_file) == folder(output) ? text : WithAbsoluteFiles(text, c.rig_file);
}

/// @throws InputError unless the catalogue's effect has a curve
void RequireRefinable(const std::string& effect) {
  if (IsRefinable(effect)) return;
  const std::string near = FindEffect(effect) ? "" : Nearest(effect, RefinableEffects());
  if (!near.empty())
    throw InputError(fmt::format("unknown effect {}, did you mean {}?", effect, near));
  throw InputError(fmt::format("{} {}, allowed: {}", effect,
                               FindEffect(effect) ? "has no curve to refine" : "is no effect",
                               RefinableEffects()));
}

}  // namespace

Refinement Refine(const Case& whole, const std::string& effect, const std::string& target,
                  const std::string& output, const ExplainOptions& options) {
  const auto progress = [&](double f, const std::string& text) {
    if (options.stop && options.stop->load()) throw Interrupted();
    if (options.progress) options.progress(f, text);
  };
  RequireRefinable(effect);
  Refinement out;
  if (std::optional<Case> seen = WithoutTestRecords(whole))
    out.seen = std::make_unique<const Case>(*std::move(seen));
  const Case& c = out.seen ? *out.seen : whole;
  out.model = std::make_unique<CaseModel>(c);
  CaseModel thin(c, ThinningTo(c, kSearchRows));
  out.model->stop = thin.stop = options.stop;
  const Hypothesis nominal = Hypothesis::Base(c.rig);
  AdoptedRigText(ReadFile(c.rig_file), nominal, c.rig.effects);  // known before the long work
  progress(0.02, "noise floor");
  const Comparison before = Prepare(*out.model, thin, nominal);
  const double n = before.effective_sample_size;
  out.warnings = before.left_out;
  progress(0.1, "rig parameters");
  NamedLaw law = FitNamedLaw(thin, effect, target, n, progress);
  const EffectInstance named = law.fit.hypothesis.rig.effects[law.index];
  out.effect = named.name;
  out.target = named.target;
  progress(0.5, "where the records drive the law");
  out.shape = ShapeOf(named, c.rig, ReachOf(thin, law.fit.hypothesis, named));
  ShapeFitOptions shape_options;
  shape_options.effective_sample_size = n;
  shape_options.progress = [&](double f, const std::string& t) { progress(0.55 + 0.3 * f, t); };
  out.fit = FitShape(thin, WithoutEffect(law.fit.hypothesis, law.index), out.shape, shape_options);
  if (!out.fit.fit.converged)
    throw InputError(
        fmt::format("{}: the shape that starts at the fitted {} loses the rotor", c.file, effect));
  progress(0.85, "what the coils differ by");
  if (RenewCoilErrors(thin, out.fit.fit.hypothesis, n)) {
    shape_options.progress = {};
    FitBesideCoilErrors(thin, shape_options, law, out);
  }
  progress(0.9, "all rows");
  DrawCurve(out);
  out.rig_text = RigText(c, out, output);
  const Hypothesis written = Hypothesis::Base(ReadRigText(out.rig_text, output));  // must read back
  out.residual_before =
      AllRows(*out.model, law.fit.hypothesis, &out.ratio_fit_before, &out.ratio_before);
  out.residual_after = AllRows(*out.model, written, &out.ratio_fit_after, &out.ratio_after);
  out.any_unseen = AnyValidates(c);
  out.ladder = {{"parameters", law.base.ratio_fit, law.base.ratio_validate},
                {NameAtTarget(effect, named.target), out.ratio_fit_before, out.ratio_before},
                {"refined", out.ratio_fit_after, out.ratio_after}};
  Warn(out, Misfit(out.ratio_fit_before, n) - Misfit(out.ratio_fit_after, n) > kLeastGain ||
                out.ratio_after < out.ratio_before);
  return out;
}

}  // namespace ambrig
