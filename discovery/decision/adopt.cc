#include "discovery/decision/adopt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "core/base/read_file.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/search/screen.h"
#include "effects/catalogue.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

std::string TomlNumber(double v) {
  if (std::isinf(v)) return v > 0 ? "inf" : "-inf";
  std::string text = fmt::format("{:.9g}", v);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string EffectText(const EffectInstance& e) {
  std::string text = fmt::format("\n[[effect]]\nname = \"{}\"\n", e.name);
  if (!e.label.empty()) text += fmt::format("label = \"{}\"\n", e.label);
  text += fmt::format("target = \"{}\"\nparameters = {{ ", e.target);
  for (std::size_t k = 0; k < e.table.size(); ++k) {
    const bool formula = e.IsFormula();
    text += fmt::format("{}{} = ", k == 0 ? "" : ", ", e.table[k].name);
    if (!formula && (k >= e.sd.size() || e.sd[k] <= 0)) {
      text += TomlNumber(e.values[k]);
      continue;
    }
    text += fmt::format("{{ value = {}", TomlNumber(e.values[k]));
    if (k < e.sd.size() && e.sd[k] > 0) text += fmt::format(", sd = {}", TomlNumber(e.sd[k]));
    if (formula) {
      if (e.table[k].has_null)
        text += fmt::format(", null = {}", TomlNumber(e.table[k].null_value));
      text += fmt::format(", min = {}, max = {}, unit = \"{}\"", TomlNumber(e.table[k].lo),
                          TomlNumber(e.table[k].hi), e.table[k].unit);
    }
    text += " }";
  }
  text += " }\n";
  // force, reading: inline tables; voltage, torque: texts
  std::map<std::string, std::string> kinds;
  for (const auto& [where, formula] : e.formulas) {
    const auto dot = where.find('.');
    if (dot == std::string::npos) {
      text += fmt::format("{} = \"{}\"\n", where, formula);
    } else {
      std::string& inside = kinds[where.substr(0, dot)];
      inside +=
          fmt::format("{}{} = \"{}\"", inside.empty() ? "" : ", ", where.substr(dot + 1), formula);
    }
  }
  for (const auto& [kind, inside] : kinds) text += fmt::format("{} = {{ {} }}\n", kind, inside);
  return text;
}

/// The text without its [[effect]] tables.
std::string WithoutEffects(const std::string& text) {
  std::istringstream in(text);
  std::string out, line;
  bool inside = false;
  while (std::getline(in, line)) {
    const std::string trimmed = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
    if (trimmed.starts_with("["))
      inside = trimmed.starts_with("[[effect]]") || trimmed.starts_with("[effect.");
    if (!inside) out += line + "\n";
  }
  while (out.ends_with("\n\n")) out.pop_back();
  return out;
}

void CheckTarget(const EffectDescription& d, const Case& c, const std::string& wanted) {
  std::string names;
  for (const auto& t : TargetsOf(d, TargetsOfEffects(c.rig))) {
    if (t == wanted || wanted.empty()) return;
    names += (names.empty() ? "" : ", ") + t;
  }
  throw InputError(fmt::format("--target = {}, allowed with {}: {}", wanted, d.id,
                               names.empty() ? "no target of this rig" : names));
}

/// The effect at the named target, or where it explains most.
FitResult FitEffect(const CaseModel& model, const FitResult& base, const ScreenOptions& what) {
  SignatureBank bank;
  const std::vector<Candidate> candidates =
      Screen(model, base, FindPeaks(model, base.residual), what, bank);
  FitResult best;
  best.ratio_fit = kInfinity;
  for (std::size_t k = 0; k < std::min<std::size_t>(candidates.size(), 3); ++k) {
    FitResult fit = FitBriefly(model, base, candidates[k], what.effective_sample_size);
    if (fit.converged && fit.ratio_fit < best.ratio_fit) best = std::move(fit);
  }
  return best;
}

}  // namespace

std::string AdoptedRigText(const std::string& text, const Hypothesis& h,
                           const std::vector<EffectInstance>& effects) {
  std::map<std::string, const FreeParameter*> fitted;  // by path
  for (const FreeParameter& p : h.free)
    if (p.effect < 0) fitted[p.path] = &p;
  std::istringstream in(WithoutEffects(text));
  std::string out, section, line;
  std::vector<std::string> copies;  // fitted values of numbers that a bearing has from `like`
  std::map<std::string, bool> written;
  std::map<std::string, int> tables;  // [[...]] so far
  const auto flush_inherited = [&] {
    // A `like` bearing inherits value and sd; its own calibration needs its own line.
    if (section.rfind("bearings.", 0) != 0) return;
    for (const auto& [path, p] : fitted) {
      if (written[path] || path.rfind(section + ".", 0) != 0) continue;
      const std::string key = path.substr(section.size() + 1);
      if (key.find('.') != std::string::npos) continue;
      out += fmt::format("{} = {{ value = {}, sd = {}, fitted = {} }}\n", key, TomlNumber(p->start),
                         TomlNumber(p->sd), TomlNumber(p->value));
      written[path] = true;
    }
  };
  while (std::getline(in, line)) {
    const std::string trimmed = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
    if (trimmed.starts_with("[[")) {
      flush_inherited();
      section = trimmed.substr(2, trimmed.find(']') - 2);
      section += fmt::format("[{}]", ++tables[section]);  // as paths count them
    } else if (trimmed.starts_with("[")) {
      flush_inherited();
      section = trimmed.substr(1, trimmed.find(']') - 1);
    }
    const auto equals = trimmed.find('=');
    std::string key = equals == std::string::npos ? "" : trimmed.substr(0, equals);
    while (!key.empty() && (key.back() == ' ' || key.back() == '\t')) key.pop_back();
    const auto it = fitted.find(section + "." + key);
    if (!key.empty() && it != fitted.end() && !written[it->first] &&
        line.find('{') != std::string::npos && line.find('}') != std::string::npos) {
      const std::string comment = line.substr(line.find('}') + 1);
      out += fmt::format("{} = {{ value = {}, sd = {}, fitted = {} }}{}\n", key,
                         TomlNumber(it->second->start), TomlNumber(it->second->sd),
                         TomlNumber(it->second->value), comment);
      written[it->first] = true;
      continue;
    }
    out += line + "\n";
  }
  flush_inherited();
  for (const auto& [path, p] : fitted)
    if (path.starts_with("rotor.") && !written[path])
      throw InputError(
          fmt::format("{} has its sd in the shaft's own file, allowed with adopt: the shaft's "
                      "tables in the rig file, each number "
                      "with its sd on a line of its own",
                      path));
  for (const EffectInstance& e : effects) out += EffectText(e);
  return out;
}

Adoption Adopt(const Case& c, const std::string& effect, const std::string& target,
               const std::string& output, const ExplainOptions& options) {
  const auto progress = [&](double f, const std::string& text) {
    if (options.stop && options.stop->load()) throw Interrupted();
    if (options.progress) options.progress(f, text);
  };
  const EffectDescription& d = EffectNamed(effect);
  const bool formula = d.users_own;
  const auto is_formula = [](const EffectInstance& e) { return e.IsFormula(); };
  if (formula && std::none_of(c.rig.effects.begin(), c.rig.effects.end(), is_formula))
    throw InputError(c.rig_file + ": has no [[effect]] name = \"formula\" to fit; write one first");
  if (!formula) CheckTarget(d, c, target);
  Adoption a;
  CaseModel model(c);
  model.stop = options.stop;
  const Hypothesis nominal = Hypothesis::Base(c.rig);
  AdoptedRigText(ReadFile(c.rig_file), nominal, {});  // can be written: known before the long work
  a.before = Compare(model, nominal, false);
  FitOptions fit;
  fit.effective_sample_size = a.before.effective_sample_size;
  progress(0.2, "rig parameters");
  const FitResult base = Fit(model, nominal, fit);
  a.ladder = {{"", a.before.ratio_fit, a.before.ratio_validate},
              {"parameters", base.ratio_fit, base.ratio_validate}};
  if (formula) {
    a.fit = base;  // it stands in the rig file and was fitted with the rig parameters
  } else {
    ScreenOptions what;
    what.effective_sample_size = fit.effective_sample_size;
    what.effect = effect;
    what.target = target;
    what.progress = [&](double f, const std::string& text) { progress(0.3 + 0.3 * f, text); };
    a.fit = FitEffect(model, base, what);
    if (!a.fit.converged)
      throw InputError(
          fmt::format("{}: the model loses levitation in every fit of {}", c.file, effect));
    progress(0.7, "final fit");
    a.fit = Fit(model, a.fit.hypothesis, fit);
    const EffectInstance& e = a.fit.hypothesis.rig.effects.back();
    a.ladder.push_back({e.name + " at " + e.target, a.fit.ratio_fit, a.fit.ratio_validate});
  }
  for (std::size_t k = 0; k < a.fit.hypothesis.rig.effects.size(); ++k)
    a.effects.push_back(FittedEffect(a.fit, k));
  a.rig_text = AdoptedRigText(ReadFile(c.rig_file), a.fit.hypothesis, a.effects);
  progress(0.9, "compare again");
  a.adopted_case = std::make_unique<Case>(c);
  a.adopted_case->rig = ReadRigText(a.rig_text, output);  // must read back
  a.model = std::make_unique<CaseModel>(*a.adopted_case);
  a.after = Compare(*a.model, Hypothesis::Base(a.adopted_case->rig), true);
  return a;
}

}  // namespace ambrig
