#include "discovery/screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <set>

#include "core/math/constants.h"
#include "discovery/probes.h"
#include "scenarios/rig.h"

namespace ambrig {

namespace {

using Eigen::Index;

/// Gram matrices of [columns of the free parameters, residual] on the fit and on the unseen records.
struct Gram {
  Eigen::MatrixXd fit, validate;
};

class Screener {
 public:
  Screener(const CaseModel& model, const FitResult& base, const ScreenOptions& options)
      : model_(model), base_(base), options_(options), nb_(base.jacobian.cols()) {
    columns_.resize(static_cast<Index>(model.size()), nb_ + 1);
    columns_.leftCols(nb_) = base.jacobian;
    columns_.col(nb_) = Eigen::Map<const Eigen::VectorXd>(base.residual.data(), static_cast<Index>(base.residual.size()));
    for (const Target& t : model.targets()) {
      double n = 0;
      for (std::size_t k = t.first; k < t.first + t.count; ++k) n += model.ok()[k];
      (Counts(model, t, Which::kFit) ? n_fit_ : n_validate_) += n;
    }
    own_ = Products(columns_, columns_);
  }

  /// The best linear explanation of the residual by the group's signatures.
  Candidate Judge(const ProbeGroup& group, const std::vector<std::vector<double>>& predicted) const {
    const auto m = static_cast<Index>(predicted.size());
    Eigen::MatrixXd D(static_cast<Index>(model_.size()), m);
    for (Index c = 0; c < m; ++c) FillSignature(predicted[static_cast<std::size_t>(c)], D.col(c));
    const Gram with = Products(columns_, D), among = Products(D, D);
    const Gram all = {Assemble(own_.fit, with.fit, among.fit), Assemble(own_.validate, with.validate, among.validate)};
    Eigen::VectorXd best;
    double best_score = kInfinity, best_fit = 0, best_validate = 0;
    const double weight = options_.effective / std::max(1.0, n_fit_ + n_validate_);
    // A signature of finite size is believed near its own size only.
    const std::vector<double> scales = group.linear ? std::vector<double>{0} : std::vector<double>{0.6, 0.8, 1.0, 1.25, 1.6};
    for (double scale : scales) {
      const Eigen::VectorXd c = Solve(all.fit, weight, m, group.linear, scale);
      const double fit = std::sqrt(std::max(0.0, c.dot(all.fit * c)) / std::max(1.0, n_fit_));
      const double validate = n_validate_ > 0 ? std::sqrt(std::max(0.0, c.dot(all.validate * c)) / n_validate_) : fit;
      const double score = Score(model_, fit, validate, options_.effective, ParametersOf(group));
      if (score >= best_score) continue;
      best_score = score;
      best = c;
      best_fit = fit;
      best_validate = validate;
    }
    return MakeCandidate(group, best, best_score, best_fit, best_validate);
  }

 private:
  int ParametersOf(const ProbeGroup& g) const { return static_cast<int>(g.probes[0].table.size()); }

  void FillSignature(const std::vector<double>& predicted, Eigen::Ref<Eigen::VectorXd> column) const {
    for (const Target& t : model_.targets())
      for (std::size_t k = t.first; k < t.first + t.count; ++k)
        column(static_cast<Index>(k)) = model_.ok()[k] ? (predicted[k] - base_.predicted[k]) / t.floor : 0;
  }

  Gram Products(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const {
    Gram g = {Eigen::MatrixXd::Zero(a.cols(), b.cols()), Eigen::MatrixXd::Zero(a.cols(), b.cols())};
    for (const Target& t : model_.targets()) {
      const auto first = static_cast<Index>(t.first), count = static_cast<Index>(t.count);
      (Counts(model_, t, Which::kFit) ? g.fit : g.validate).noalias() +=
          a.middleRows(first, count).transpose() * b.middleRows(first, count);
    }
    return g;
  }

  static Eigen::MatrixXd Assemble(const Eigen::MatrixXd& own, const Eigen::MatrixXd& with, const Eigen::MatrixXd& among) {
    Eigen::MatrixXd all(own.rows() + among.rows(), own.cols() + among.cols());
    all << own, with, with.transpose(), among;
    return all;
  }

  /// Coefficients [-delta, 1, -a] of [rig columns, residual, signatures] that minimise the fit error.
  Eigen::VectorXd Solve(const Eigen::MatrixXd& gram, double weight, Index m, bool linear, double scale) const {
    Eigen::VectorXd c = Eigen::VectorXd::Zero(nb_ + 1 + m);
    c(nb_) = 1;
    std::vector<Index> free;
    for (Index k = 0; k < nb_; ++k) free.push_back(k);
    if (linear)
      for (Index k = 0; k < m; ++k) free.push_back(nb_ + 1 + k);
    else
      c(nb_ + 1) = -scale;
    const auto n = static_cast<Index>(free.size());
    Eigen::MatrixXd A(n, n);
    Eigen::VectorXd b(n);
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) A(i, j) = weight * gram(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]);
      b(i) = -weight * gram.row(free[static_cast<std::size_t>(i)]).dot(c);
      const auto column = static_cast<std::size_t>(free[static_cast<std::size_t>(i)]);
      if (static_cast<Index>(column) < nb_ && base_.hypothesis.free[column].sd > 0) {
        A(i, i) += 1;  // prior: one sd each, about the nominal value
        b(i) += base_.hypothesis.Coordinate(column);
      } else {
        A(i, i) += 1e-9 * A(i, i) + 1e-12;
      }
    }
    // x is [-delta, -a]: a parameter that rises lowers the residual.
    Eigen::VectorXd x = A.ldlt().solve(b);
    for (Index i = 0; i < n; ++i) c(free[static_cast<std::size_t>(i)]) = x(i);
    return c;
  }

  Candidate MakeCandidate(const ProbeGroup& group, const Eigen::VectorXd& c, double score, double fit, double validate) const {
    Candidate out;
    out.effect = group.probes[0];
    out.score = score;
    out.ratio_fit = fit;
    out.ratio_validate = validate;
    if (!group.linear) return out;
    for (std::size_t k = 0; k < group.rows.size(); ++k) {
      const std::size_t row = group.rows[k];
      const EffectParameter& p = out.effect.table[row];
      const double size = group.probes[k].values[row] - p.null_value;
      const double a = -c(nb_ + 1 + static_cast<Index>(k));
      double value = p.null_value + a * size;
      const double margin = 1e-3 * std::abs(size);  // a start off the null, inside the bounds
      if (std::abs(value - p.null_value) < margin) value = p.null_value + (a < 0 ? -margin : margin);
      out.effect.values[row] = std::clamp(value, p.lo, p.hi);
      if (out.effect.values[row] == p.null_value) out.effect.values[row] = std::clamp(p.null_value + 0.1 * size, p.lo, p.hi);
    }
    return out;
  }

  const CaseModel& model_;
  const FitResult& base_;
  const ScreenOptions& options_;
  Index nb_;
  Eigen::MatrixXd columns_;  // rig columns and the residual
  Gram own_;
  double n_fit_ = 0, n_validate_ = 0;
};

/// Effects that no record of the case could show.
bool CannotShow(const EffectDescription& d, const CaseModel& model) {
  if (d.id == "formula") return true;
  const Case& c = model.data();
  bool moving = false, free_speed = false, contact = false, levitated = false;
  for (const CaseRecord& r : c.records) {
    moving = moving || r.scenario.speed.Speed(0) != 0 || r.scenario.speed.Speed(r.scenario.duration) != 0;
    free_speed = free_speed || r.scenario.speed_free_from < r.scenario.duration;
    contact = contact || r.scenario.start == StartState::kResting || !r.scenario.faults.empty();
    levitated = levitated || r.scenario.start != StartState::kClamped;
  }
  const bool chopper = c.rig.amplifier.modulation == Modulation::kChopper;
  if (d.id == "freewheel-drop") return !chopper;
  if (d.id == "windage") return !free_speed;
  if (d.id == "contact-friction" || d.id == "contact-mount") return !contact;
  static const std::set<std::string> turning = {"unbalance", "shaft-bow", "sensor-runout", "coupling-misalignment", "rotating-damping"};
  if (turning.contains(d.id) && !moving) return true;
  static const std::set<std::string> rotor = {"unbalance", "shaft-bow", "bending-mode", "rotating-damping", "cross-coupling",
                                              "side-pull", "coupling-misalignment", "base-mode", "base-vibration", "constant-load",
                                              "loop-delay", "sensor-lowpass"};
  return rotor.contains(d.id) && !levitated;
}

}  // namespace

double Score(const CaseModel& model, double ratio_fit, double ratio_validate, double effective, int parameters) {
  double fit = 0, validate = 0;
  for (const Target& t : model.targets()) (Counts(model, t, Which::kFit) ? fit : validate) += static_cast<double>(t.count);
  const double n_fit = effective * fit / (fit + validate), n_validate = effective * validate / (fit + validate);
  const double floor = 1e-6;
  return n_fit * std::log(std::max(ratio_fit * ratio_fit, floor)) + n_validate * std::log(std::max(ratio_validate * ratio_validate, floor)) +
         parameters * std::log(effective);
}

std::vector<Candidate> Screen(const CaseModel& model, const FitResult& base, const ScreenOptions& options) {
  struct Job {
    ProbeGroup group;
    Candidate result;
    bool fine = false;
  };
  std::vector<Job> jobs;
  const EffectTargets targets = TargetsOfEffects(model.data().rig);
  for (const EffectDescription& d : Catalogue()) {
    if (CannotShow(d, model)) continue;
    for (const std::string& target : TargetsOf(d, targets)) {
      bool present = false;
      for (const EffectInstance& e : base.hypothesis.rig.effects) present = present || (e.name == d.id && e.target == target);
      if (present) continue;
      for (ProbeGroup& g : ProbesOf(d, target, model, base.residual)) jobs.push_back({std::move(g), {}, false});
    }
  }
  const Screener screener(model, base, options);
  constexpr std::size_t kChunk = 16;  // predictions of a chunk are in memory together
  for (std::size_t first = 0; first < jobs.size();) {
    std::vector<Hypothesis> all;
    std::size_t last = first;
    while (last < jobs.size() && (last == first || all.size() + jobs[last].group.probes.size() <= kChunk)) {
      for (const EffectInstance& e : jobs[last].group.probes) {
        all.push_back(base.hypothesis);
        all.back().rig.effects.push_back(e);
      }
      ++last;
    }
    if (options.progress)
      options.progress(static_cast<double>(first) / static_cast<double>(jobs.size()), jobs[first].group.probes[0].name);
    const auto runs = model.PredictAll(all);
    std::size_t at = 0;
    for (; first < last; ++first) {
      Job& job = jobs[first];
      std::vector<std::vector<double>> predicted;
      ProbeGroup usable = job.group;
      usable.probes.clear();
      usable.rows.clear();
      for (std::size_t k = 0; k < job.group.probes.size(); ++k, ++at) {
        if (!runs[at]) continue;
        predicted.push_back(*runs[at]);
        usable.probes.push_back(job.group.probes[k]);
        if (job.group.linear) usable.rows.push_back(job.group.rows[k]);
      }
      if (predicted.empty()) continue;
      job.result = screener.Judge(usable, predicted);
      job.fine = std::isfinite(job.result.score);
    }
  }
  // The best size of every (effect, target).
  std::vector<Candidate> out;
  for (const Job& job : jobs) {
    if (!job.fine) continue;
    auto same = std::find_if(out.begin(), out.end(), [&](const Candidate& c) {
      return c.effect.name == job.result.effect.name && c.effect.target == job.result.effect.target;
    });
    if (same == out.end()) out.push_back(job.result);
    else if (job.result.score < same->score) *same = job.result;
  }
  std::stable_sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
  return out;
}

namespace {

/// Residual power of the position readings at frequency f; coherent: phases of the records must agree.
double PowerAt(const CaseModel& model, const std::vector<double>& residual, const std::string& plane, double f, bool coherent) {
  double power = 0;
  std::map<std::string, std::complex<double>> sums;
  for (const Target& t : model.targets()) {
    const CaseRecord& record = model.data().records[t.record];
    const std::string& channel = record.data.channels[t.channel].name;
    const bool reading = channel.ends_with(".x") || channel.ends_with(".y");
    if (!reading || record.scenario.start == StartState::kClamped) continue;
    if (plane != "rig" && channel.rfind(plane + ".", 0) != 0) continue;
    const double w = 2 * kPi * f / record.data.rate;
    if (w > 0.8 * kPi) continue;
    const std::complex<double> turn = std::polar(1.0, -w);
    std::complex<double> phase = std::polar(1.0, -2 * kPi * f * record.data.start), sum = 0;
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      sum += residual[k] * phase;
      phase *= turn;
    }
    if (coherent) sums[channel] += sum;
    else power += std::norm(sum) / static_cast<double>(t.count);
  }
  for (const auto& [channel, sum] : sums) power += std::norm(sum);
  return power;
}

std::vector<double> Peaks(const std::vector<double>& f, const std::vector<double>& power, std::size_t count, double apart) {
  std::vector<std::size_t> order;
  for (std::size_t k = 1; k + 1 < f.size(); ++k)
    if (power[k] >= power[k - 1] && power[k] >= power[k + 1]) order.push_back(k);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return power[a] > power[b]; });
  std::vector<double> out;
  for (std::size_t k : order) {
    if (out.size() >= count) break;
    if (std::none_of(out.begin(), out.end(), [&](double g) { return std::abs(f[k] - g) < apart * g; })) out.push_back(f[k]);
  }
  return out;
}

}  // namespace

std::vector<double> CoherentPeaks(const CaseModel& model, const std::vector<double>& residual, const std::string& plane,
                                  std::size_t count) {
  std::vector<double> f, power;
  for (double g = 8; g < 320; g += 0.4) {
    f.push_back(g);
    power.push_back(PowerAt(model, residual, plane, g, true));
  }
  return Peaks(f, power, count, 0.04);
}

std::vector<double> SpectrumPeaks(const CaseModel& model, const std::vector<double>& residual, std::size_t count) {
  std::vector<double> f, power;
  for (double g = 15; g < 2500; g *= 1.012) {
    f.push_back(g);
    power.push_back(PowerAt(model, residual, "rig", g, false));
  }
  return Peaks(f, power, count, 0.1);
}

}  // namespace ambrig
