#include "discovery/search/signature_bank.h"

#include <algorithm>

namespace ambrig {

namespace {

using Eigen::Index;

struct Span {
  Index first = 0, count = 0;
  bool validate = false;
};

/// Rows of each record: its targets lie together.
std::vector<Span> RecordSpans(const CaseModel& model) {
  std::vector<Span> spans;
  std::size_t record = static_cast<std::size_t>(-1);
  for (const Target& t : model.targets()) {
    if (t.record != record)
      spans.push_back({static_cast<Index>(t.first), 0, Counts(model, t, Which::kValidate)});
    record = t.record;
    spans.back().count += static_cast<Index>(t.count);
  }
  return spans;
}

}  // namespace

Gram RowProducts(const CaseModel& model, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Gram g = {Eigen::MatrixXd::Zero(a.cols(), b.cols()), Eigen::MatrixXd::Zero(a.cols(), b.cols())};
  for (const Span& s : RecordSpans(model))
    (s.validate ? g.validate : g.fit).noalias() +=
        a.middleRows(s.first, s.count).transpose() * b.middleRows(s.first, s.count);
  return g;
}

void SignatureBank::Simulate(const CaseModel& model, const FitResult& base,
                             const std::vector<ProbeGroup>& groups,
                             const std::function<void(double, const std::string&)>& progress) {
  constexpr std::size_t kChunk = 24;  // predictions of a chunk are in memory together
  if (groups.empty()) return;
  const auto without = model.PredictAll({base.hypothesis}, ModelFidelity::kCoarse)[0];
  if (!without) return;
  for (std::size_t first = 0; first < groups.size();) {
    std::vector<Hypothesis> all;
    std::size_t last = first;
    while (last < groups.size() &&
           (last == first || all.size() + groups[last].probes.size() <= kChunk)) {
      for (const EffectInstance& e : groups[last].probes) {
        all.push_back(base.hypothesis);
        all.back().rig.effects.push_back(e);
      }
      ++last;
    }
    if (progress)
      progress(static_cast<double>(first) / static_cast<double>(groups.size()),
               groups[first].probes[0].name);
    const auto runs = model.PredictAll(all, ModelFidelity::kCoarse);
    if (used_ + static_cast<Index>(all.size()) > columns_.cols())
      columns_.conservativeResize(
          static_cast<Index>(model.size()),
          std::max<Index>(2 * columns_.cols(), used_ + 4 * static_cast<Index>(kChunk)));
    std::size_t at = 0;
    for (; first < last; ++first) {
      Entry entry;
      entry.first = used_;
      entry.group = groups[first];
      entry.group.probes.clear();
      entry.group.rows.clear();
      for (std::size_t k = 0; k < groups[first].probes.size(); ++k, ++at) {
        if (!runs[at]) continue;
        std::vector<double> signature(model.size());
        for (const Target& t : model.targets())
          for (std::size_t row = t.first; row < t.first + t.count; ++row)
            if (model.ok()[row]) signature[row] = ((*runs[at])[row] - (*without)[row]) / t.floor;
        if (model.nuisances.any()) model.nuisances.Eliminate(signature.data());
        columns_.col(used_) =
            Eigen::Map<const Eigen::VectorXd>(signature.data(), static_cast<Index>(model.size()))
                .cast<float>();
        ++used_;
        entry.group.probes.push_back(groups[first].probes[k]);
        if (entry.group.linear) entry.group.rows.push_back(groups[first].rows[k]);
      }
      if (!entry.group.probes.empty()) entries_.push_back(std::move(entry));
    }
  }
}

bool SignatureBank::Holds(const EffectInstance& probe) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) {
    const EffectInstance& o = e.group.probes[0];
    return o.name == probe.name && o.target == probe.target && o.values == probe.values;
  });
}

const Gram& SignatureBank::Products(const CaseModel& model) {
  if (multiplied_ == used_) return products_;
  products_.fit.conservativeResizeLike(Eigen::MatrixXd::Zero(used_, used_));
  products_.validate.conservativeResizeLike(Eigen::MatrixXd::Zero(used_, used_));
  const Index n = used_ - multiplied_;
  for (const Span& s : RecordSpans(model)) {
    // All columns by the new ones, in blocks that stay in the cache and keep single precision
    // honest.
    constexpr Index kRows = 4096;
    for (Index row = s.first; row < s.first + s.count; row += kRows) {
      const Index rows = std::min(kRows, s.first + s.count - row);
      const Eigen::MatrixXf part = columns_.block(row, 0, rows, used_).transpose() *
                                   columns_.block(row, multiplied_, rows, n);
      (s.validate ? products_.validate : products_.fit).rightCols(n) += part.cast<double>();
    }
  }
  for (Eigen::MatrixXd* m : {&products_.fit, &products_.validate})
    m->bottomLeftCorner(n, multiplied_) = m->topRightCorner(multiplied_, n).transpose();
  multiplied_ = used_;
  return products_;
}

Gram SignatureBank::ProductsWith(const CaseModel& model, const Eigen::MatrixXd& a) const {
  Gram g = {Eigen::MatrixXd::Zero(a.cols(), used_), Eigen::MatrixXd::Zero(a.cols(), used_)};
  constexpr Index kRows = 4096;
  for (const Span& s : RecordSpans(model))
    for (Index row = s.first; row < s.first + s.count; row += kRows) {
      const Index rows = std::min(kRows, s.first + s.count - row);
      (s.validate ? g.validate : g.fit).noalias() +=
          a.middleRows(row, rows).transpose() * columns_.block(row, 0, rows, used_).cast<double>();
    }
  return g;
}

}  // namespace ambrig
