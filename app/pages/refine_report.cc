#include "app/pages/refine_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/pages/discovery_parts.h"
#include "app/text/format.h"

namespace ambrig {
namespace {

/// One line of the curve's figure; NaN where it is not drawn.
struct Line {
  std::vector<double> values;
  explicit Line(std::size_t n) : values(n, std::nan("")) {}
};

bool Supported(const CurvePoint& p) { return p.visited && p.support > kSupported; }

Figure LawFigure(const Refinement& r) {
  const std::size_t n = r.curve.size();
  std::vector<double> u, low, high, named, support;
  Line solid(n), dotted(n);
  for (std::size_t k = 0; k < n; ++k) {
    const CurvePoint& p = r.curve[k];
    u.push_back(p.u);
    low.push_back(p.value - 2 * p.sd);
    high.push_back(p.value + 2 * p.sd);
    named.push_back(p.named);
    support.push_back(p.visited ? p.support : 0);
    const bool neighbour =
        (k > 0 && Supported(r.curve[k - 1])) || (k + 1 < n && Supported(r.curve[k + 1]));
    if (Supported(p)) solid.values[k] = p.value;
    if (!Supported(p) || (neighbour && !Supported(p))) dotted.values[k] = p.value;
    if (Supported(p) &&
        ((k > 0 && !Supported(r.curve[k - 1])) || (k + 1 < n && !Supported(r.curve[k + 1]))))
      dotted.values[k] = p.value;
  }
  if (r.shape.logarithmic)
    for (double& v : low) v = std::max(v, 1e-6);
  Grid grid;
  grid.rows = 2;
  Figure f = MakeFigure(
      fmt::format("The law of {} at {}: {} against {}. Solid where the records support it (at "
                  "least {:.0f} % of the prior variance removed, and visited), dotted where it is "
                  "a continuation; shaded: 2 sd; grey: the catalogue's law as fitted. Below: the "
                  "support.",
                  r.effect, r.target, r.shape.value_name, r.shape.u_name, 100 * kSupported),
      grid);
  AddBand(f, 0, "2 sd", u, low, high, "@blue");
  AddLine(f, 0, "catalogue's law", u, named, {.color = "@gray", .dash = "dash"});
  AddLine(f, 0, "refined, supported", u, solid.values, {.color = "@blue", .width = 2.5});
  AddLine(f, 0, "refined, continued", u, dotted.values, {.color = "@blue", .dash = "dot"});
  AddLine(f, 1, "support", u, support, {.color = "@green", .legend = false});
  const std::string x = fmt::format("{} [{}]", r.shape.u_name, r.shape.u_unit);
  SetAxes(f, 0, "", fmt::format("{} [{}]", r.shape.value_name, r.shape.value_unit));
  SetAxes(f, 1, x, "support [-]", {}, std::array<double, 2>{0, 1.05});
  AddLevel(f, 1, kSupported, "supported above");
  if (r.shape.logarithmic) {
    LogAxes(f, 0, true, true);
    LogAxes(f, 1, true, false);
  }
  return f;
}

void AddResult(HtmlReport& report, const Refinement& r) {
  const std::string where = r.any_unseen ? "unseen records" : "all records (none is unseen)";
  const std::string text = fmt::format(
      "**{} at {}**: error over noise on {} {:.2f} with the catalogue's law, **{:.2f}** with the "
      "refined one; {}.",
      r.effect, r.target, where, r.ratio_before, r.ratio_after, SupportText(r));
  if (r.supported_hi <= r.supported_lo || r.ratio_after > 0.999 * r.ratio_before)
    report.Verdict(Verdict::kWarn, text);
  else
    report.Verdict(r.ratio_after < 1.1 ? Verdict::kOk : Verdict::kInfo, text);
  if (!r.warnings.empty()) report.Text(List(r.warnings));
  AddReadingHelp(report, true);
}

void AddSizes(HtmlReport& report, const Refinement& r) {
  const EffectInstance& e = r.fit.fit.hypothesis.rig.effects.back();
  std::vector<std::vector<Cell>> rows;
  for (std::size_t k = 0; k < r.shape.rows.size(); ++k) {
    const EffectParameter& p = e.table[r.shape.rows[k]];
    const auto i = static_cast<Eigen::Index>(k);
    rows.push_back({p.name, ValueText(r.fit.sizes[k], std::sqrt(r.fit.posterior(i, i)), p.unit),
                    r.fit.influence[k] > 1 ? "yes" : "no", p.doc});
  }
  report.Table({"size", "value ± sd", "determined", "meaning"}, rows,
               fmt::format("The sizes of `{}` in the new rig file. Weight of the smoothness, "
                           "chosen by the evidence: {:.2g}.",
                           e.name, r.fit.smoothing));
}

}  // namespace

std::string SupportText(const Refinement& r) {
  if (r.supported_hi <= r.supported_lo) return "supported nowhere by these records";
  const std::vector<double>& u = r.shape.u;
  if (!u.empty() && r.supported_lo <= u.front() && r.supported_hi >= u.back())
    return "supported at every " + r.shape.u_name;
  return fmt::format("supported for {} = {} to {} only", r.shape.u_name,
                     FormatSi(r.supported_lo, r.shape.u_unit, 3),
                     FormatSi(r.supported_hi, r.shape.u_unit, 3));
}

void WriteRefineReport(const Refinement& r, const std::string& rig, const std::string& path) {
  HtmlReport report("Law refined", r.model->data().file);
  report.Heading("Result");
  AddResult(report, r);
  report.Heading("The law");
  report.AddFigure(LawFigure(r));
  AddSizes(report, r);
  report.Heading("Error after each step");
  AddLadder(report, r.ladder);
  report.Heading("Before and after");
  AddRatioMap(report, *r.model, r.residual_before,
              "With the catalogue's law: error over noise of every channel in every record.");
  AddRatioMap(report, *r.model, r.residual_after, fmt::format("With the refined law ({}).", rig));
  report.Write(path);
}

}  // namespace ambrig
