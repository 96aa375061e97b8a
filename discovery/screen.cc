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

constexpr std::size_t kStride = 5;  // rows between those that the screening looks at

/// Rows of the flat vectors that take part, fit records first.
struct Rows {
  std::vector<std::size_t> at;
  std::vector<double> floor;
  Index fit = 0;  // the first so many belong to fit records

  explicit Rows(const CaseModel& model) {
    for (const Which which : {Which::kFit, Which::kValidate}) {
      for (const Target& t : model.targets()) {
        if (!Counts(model, t, which)) continue;
        for (std::size_t k = t.first; k < t.first + t.count; k += kStride)
          if (model.ok()[k]) {
            at.push_back(k);
            floor.push_back(t.floor);
          }
      }
      if (which == Which::kFit) fit = static_cast<Index>(at.size());
    }
  }
  Index size() const { return static_cast<Index>(at.size()); }
};

/// Gram matrices of [columns of the free parameters, residual] on the fit and on the unseen records.
struct Gram {
  Eigen::MatrixXd fit, validate;
};

class Screener {
 public:
  Screener(const CaseModel& model, const FitResult& base, const ScreenOptions& options)
      : model_(model), base_(base), options_(options), rows_(model), nb_(base.jacobian.cols()) {
    columns_.resize(rows_.size(), nb_ + 1);
    for (Index k = 0; k < rows_.size(); ++k) {
      const auto row = static_cast<Index>(rows_.at[static_cast<std::size_t>(k)]);
      columns_.row(k).head(nb_) = base.jacobian.row(row);
      columns_(k, nb_) = base.residual[static_cast<std::size_t>(row)];
    }
    n_fit_ = static_cast<double>(rows_.fit);
    n_validate_ = static_cast<double>(rows_.size() - rows_.fit);
    own_ = Products(columns_, columns_);
  }

  /// Change of the prediction over the floor, on the rows that take part.
  Eigen::VectorXf Signature(const std::vector<double>& predicted) const {
    Eigen::VectorXf out(rows_.size());
    for (Index k = 0; k < rows_.size(); ++k) {
      const std::size_t row = rows_.at[static_cast<std::size_t>(k)];
      out(k) = static_cast<float>((predicted[row] - base_.predicted[row]) / rows_.floor[static_cast<std::size_t>(k)]);
    }
    return out;
  }

  /// The best linear explanation of the residual by the group's signatures.
  Candidate Judge(const ProbeGroup& group, const std::vector<Eigen::VectorXf>& signatures) const {
    const auto m = static_cast<Index>(signatures.size());
    Eigen::MatrixXd D(rows_.size(), m);
    for (Index c = 0; c < m; ++c) D.col(c) = signatures[static_cast<std::size_t>(c)].cast<double>();
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
      const double score = Score(model_, fit, validate, options_.effective, static_cast<int>(group.probes[0].table.size()));
      if (score >= best_score) continue;
      best_score = score;
      best = c;
      best_fit = fit;
      best_validate = validate;
    }
    return MakeCandidate(group, best, best_score, best_fit, best_validate);
  }

 private:
  Gram Products(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const {
    const Index rest = rows_.size() - rows_.fit;
    return {a.topRows(rows_.fit).transpose() * b.topRows(rows_.fit), a.bottomRows(rest).transpose() * b.bottomRows(rest)};
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
  Rows rows_;
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

struct SignatureBank::Entry {
  ProbeGroup group;                       // only the probes that the rotor survived
  std::vector<Eigen::VectorXf> columns;
};
SignatureBank::SignatureBank() : entries_(std::make_unique<std::vector<Entry>>()) {}
SignatureBank::~SignatureBank() = default;

namespace {

bool SeeksFrequency(const EffectDescription& d) {
  return std::any_of(d.parameters.begin(), d.parameters.end(), [](const EffectParameter& p) { return p.name == "frequency"; });
}

/// Simulates the groups' probes chunk by chunk and puts their signatures into the bank.
void Simulate(const CaseModel& model, const FitResult& base, const Screener& screener, std::vector<ProbeGroup> groups,
              const ScreenOptions& options, double from, double to, SignatureBank& bank) {
  constexpr std::size_t kChunk = 16;  // predictions of a chunk are in memory together
  for (std::size_t first = 0; first < groups.size();) {
    std::vector<Hypothesis> all;
    std::size_t last = first;
    while (last < groups.size() && (last == first || all.size() + groups[last].probes.size() <= kChunk)) {
      for (const EffectInstance& e : groups[last].probes) {
        all.push_back(base.hypothesis);
        all.back().rig.effects.push_back(e);
      }
      ++last;
    }
    if (options.progress)
      options.progress(from + (to - from) * static_cast<double>(first) / static_cast<double>(groups.size()), groups[first].probes[0].name);
    const auto runs = model.PredictAll(all);
    std::size_t at = 0;
    for (; first < last; ++first) {
      SignatureBank::Entry entry;
      entry.group.linear = groups[first].linear;
      for (std::size_t k = 0; k < groups[first].probes.size(); ++k, ++at) {
        if (!runs[at]) continue;
        entry.columns.push_back(screener.Signature(*runs[at]));
        entry.group.probes.push_back(groups[first].probes[k]);
        if (entry.group.linear) entry.group.rows.push_back(groups[first].rows[k]);
      }
      if (!entry.columns.empty()) bank.entries().push_back(std::move(entry));
    }
  }
}

/// Probes of one kind of target (coils or the others) that the bank does not hold yet.
std::vector<ProbeGroup> GroupsToRun(const CaseModel& model, const FitResult& base, bool coils, bool again) {
  std::vector<ProbeGroup> groups;
  const EffectTargets targets = TargetsOfEffects(model.data().rig);
  for (const EffectDescription& d : Catalogue()) {
    if (CannotShow(d, model) || (again && !SeeksFrequency(d))) continue;
    for (const std::string& target : TargetsOf(d, targets)) {
      if ((target.find(".coil") != std::string::npos) != coils) continue;
      for (ProbeGroup& g : ProbesOf(d, target, model, base.residual)) groups.push_back(std::move(g));
    }
  }
  return groups;
}

void Rank(const FitResult& base, const Screener& screener, SignatureBank& bank, std::vector<Candidate>& out) {
  out.clear();
  for (const SignatureBank::Entry& entry : bank.entries()) {
    const EffectInstance& e = entry.group.probes[0];
    const bool present = std::any_of(base.hypothesis.rig.effects.begin(), base.hypothesis.rig.effects.end(),
                                     [&](const EffectInstance& o) { return o.name == e.name && o.target == e.target; });
    if (present) continue;
    Candidate c = screener.Judge(entry.group, entry.columns);
    if (!std::isfinite(c.score)) continue;
    auto same = std::find_if(out.begin(), out.end(), [&](const Candidate& o) {
      return o.effect.name == c.effect.name && o.effect.target == c.effect.target;
    });
    if (same == out.end()) out.push_back(std::move(c));
    else if (c.score < same->score) *same = std::move(c);
  }
  std::stable_sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
}

}  // namespace

std::vector<Candidate> Screen(const CaseModel& model, const FitResult& base, const ScreenOptions& options,
                              SignatureBank& bank) {
  const Screener screener(model, base, options);
  const bool again = !bank.entries().empty();
  std::vector<Candidate> out;
  Simulate(model, base, screener, GroupsToRun(model, base, false, again), options, 0, 0.7, bank);
  Rank(base, screener, bank, out);
  if (again) return out;
  // Single coils are many; they are tried where nothing else explains nearly all.
  const double excess = base.ratio_validate * base.ratio_validate - 1;
  const double left = out.empty() ? excess : out[0].ratio_validate * out[0].ratio_validate - 1;
  if (left > 0.12 * excess) {
    Simulate(model, base, screener, GroupsToRun(model, base, true, false), options, 0.7, 1, bank);
    Rank(base, screener, bank, out);
  }
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
