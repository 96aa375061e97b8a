#include "discovery/search/signature_bank.h"

#include <algorithm>

#include "discovery/model/in_parallel.h"
#include "discovery/model/residual.h"

namespace ambrig {

namespace {

using Eigen::Index;

constexpr std::size_t kChunk = 24;  // predictions of a chunk are in memory together

struct Span {
  Index first = 0, count = 0;
  bool validate = false, points = false;
};

/// Rows of each record: its targets lie together.
std::vector<Span> RecordSpans(const CaseModel& model) {
  std::vector<Span> spans;
  std::size_t record = static_cast<std::size_t>(-1);
  for (const Target& t : model.targets()) {
    if (t.record != record)
      spans.push_back({static_cast<Index>(t.first), 0, Counts(model, t, Which::kValidate),
                       !OverTime(model.data().records[t.record])});
    record = t.record;
    spans.back().count += static_cast<Index>(t.count);
  }
  return spans;
}

/// The same in blocks that stay in the cache and keep sums in single precision honest.
std::vector<Span> RowBlocks(const CaseModel& model) {
  constexpr Index kRows = 4096;
  std::vector<Span> blocks;
  for (const Span& s : RecordSpans(model))
    for (Index row = s.first; row < s.first + s.count; row += kRows)
      blocks.push_back({row, std::min(kRows, s.first + s.count - row), s.validate, s.points});
  return blocks;
}

/// Adds what `product` gives of each span of rows, in their order.
template <class Product>
void AddProducts(const std::vector<Span>& spans, Gram* sum, const Product& product) {
  std::vector<Eigen::MatrixXd> parts(spans.size());
  InParallel(spans.size(), [&](std::size_t k) { parts[k] = product(spans[k]); });
  for (std::size_t k = 0; k < spans.size(); ++k) {
    (spans[k].validate ? sum->validate : sum->fit) += parts[k];
    if (spans[k].points) (spans[k].validate ? sum->validate_points : sum->fit_points) += parts[k];
  }
}

}  // namespace

Gram Gram::Zero(const CaseModel& model, Index rows, Index cols) {
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(rows, cols);
  if (std::ranges::all_of(model.data().records, OverTime)) return {zero, zero, {}, {}};
  return {zero, zero, zero, zero};
}

Gram RowProducts(const CaseModel& model, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Gram g = Gram::Zero(model, a.cols(), b.cols());
  AddProducts(RecordSpans(model), &g, [&](const Span& s) -> Eigen::MatrixXd {
    return a.middleRows(s.first, s.count).transpose() * b.middleRows(s.first, s.count);
  });
  return g;
}

std::vector<std::vector<float>> SignatureBank::Signatures(const CaseModel& model,
                                                          const Hypothesis& base,
                                                          const std::vector<EffectInstance>& probes,
                                                          const RecordSubset* look) const {
  std::vector<Hypothesis> all;
  for (const EffectInstance& e : probes) {
    all.push_back(base);
    all.back().rig.effects.push_back(e);
  }
  all.push_back(base);
  const auto runs = model.PredictAll(all, ModelFidelity::kCoarse, look);
  const auto& without = runs.back();
  std::vector<std::vector<float>> out(probes.size());
  std::vector<double> signature(model.size());
  for (std::size_t k = 0; without && k < probes.size(); ++k) {
    if (!runs[k]) continue;
    ChangeOverFloor(model, *without, *runs[k], signature.data());
    DropJumps(model, signature.data());
    if (model.nuisances.any())
      model.nuisances.Eliminate(signature.data(), look ? &look->records : nullptr);
    out[k].assign(signature.begin(), signature.end());
  }
  return out;
}

void SignatureBank::TakeSmaller(const CaseModel& model, const Hypothesis& base,
                                const std::vector<int>& rows, std::vector<EffectInstance>& probes,
                                std::vector<std::vector<float>>& signatures) const {
  constexpr int kTimes = 3;
  constexpr double kSmaller = 0.1;
  for (int time = 0; time < kTimes; ++time) {
    std::vector<std::size_t> lost;
    std::vector<EffectInstance> smaller;
    for (std::size_t k = 0; k < probes.size(); ++k) {
      if (rows[k] < 0 || !signatures[k].empty()) continue;
      const auto row = static_cast<std::size_t>(rows[k]);
      const double null = probes[k].table[row].null_value;
      probes[k].values[row] = null + kSmaller * (probes[k].values[row] - null);
      lost.push_back(k);
      smaller.push_back(probes[k]);
    }
    if (lost.empty()) return;
    auto again = Signatures(model, base, smaller, look_ ? &*look_ : nullptr);
    for (std::size_t k = 0; k < lost.size(); ++k) signatures[lost[k]] = std::move(again[k]);
  }
}

void SignatureBank::Simulate(const CaseModel& model, const FitResult& base,
                             const std::vector<ProbeGroup>& groups,
                             const std::function<void(double, const std::string&)>& progress) {
  if (groups.empty()) return;
  const auto hypothesis = std::make_shared<const Hypothesis>(base.hypothesis);
  for (std::size_t first = 0; first < groups.size();) {
    std::vector<EffectInstance> probes;
    std::vector<int> rows;
    std::size_t last = first;
    for (; last < groups.size() &&
           (last == first || probes.size() + groups[last].probes.size() <= kChunk);
         ++last)
      for (std::size_t k = 0; k < groups[last].probes.size(); ++k) {
        probes.push_back(groups[last].probes[k]);
        rows.push_back(groups[last].linear ? static_cast<int>(groups[last].rows[k]) : -1);
      }
    if (progress)
      progress(static_cast<double>(first) / static_cast<double>(groups.size()),
               groups[first].probes[0].name);
    auto signatures = Signatures(model, *hypothesis, probes, look_ ? &*look_ : nullptr);
    TakeSmaller(model, *hypothesis, rows, probes, signatures);
    if (used_ + static_cast<Index>(probes.size()) > columns_.cols())
      columns_.conservativeResize(
          static_cast<Index>(model.size()),
          std::max<Index>(2 * columns_.cols(), used_ + 4 * static_cast<Index>(kChunk)));
    std::size_t at = 0;
    for (; first < last; ++first) {
      Entry entry{groups[first], used_, hypothesis};
      entry.group.probes.clear();
      entry.group.rows.clear();
      for (std::size_t k = 0; k < groups[first].probes.size(); ++k, ++at) {
        if (signatures[at].empty() || Holds(probes[at])) continue;
        columns_.col(used_++) = Eigen::Map<const Eigen::VectorXf>(signatures[at].data(),
                                                                  static_cast<Index>(model.size()));
        entry.group.probes.push_back(probes[at]);
        if (entry.group.linear) entry.group.rows.push_back(groups[first].rows[k]);
      }
      if (!entry.group.probes.empty()) entries_.push_back(std::move(entry));
    }
  }
}

void SignatureBank::LookAt(const CaseModel& model, const RecordSubset& look) {
  if (!look_ && !entries_.empty()) return;  // has all
  RecordSubset missing = look;
  bool any = false;
  for (std::size_t r = 0; look_ && r < look.records.size(); ++r) {
    missing.records[r] = look.records[r] && !look_->records[r];
    any = any || missing.records[r];
    look_->records[r] = look_->records[r] || look.records[r];
  }
  if (!look_) look_ = look;
  if (!any) return;
  for (std::size_t begin = 0; begin < entries_.size();) {
    std::size_t end = begin, probes = 0;
    while (end < entries_.size() && probes < kChunk && entries_[end].base == entries_[begin].base)
      probes += entries_[end++].group.probes.size();
    Fill(model, begin, end, missing);
    begin = end;
  }
  ForgetProducts();
}

void SignatureBank::Rescale(const CaseModel& model, const std::vector<Target>& before) {
  for (std::size_t n = 0; n < before.size(); ++n) {
    const Target& t = model.targets()[n];
    const auto factor = static_cast<float>(before[n].floor / t.floor);
    for (std::size_t row = t.first; row < t.first + t.count; ++row)
      columns_.row(static_cast<Index>(row)) *= model.ok()[row] ? factor : 0.0F;
  }
  ForgetProducts();
}

void SignatureBank::ForgetProducts() {
  multiplied_ = 0;
  products_ = Gram();
}

void SignatureBank::TakeOffNuisances(const CaseModel& model) {
  InParallel(static_cast<std::size_t>(used_), [&](std::size_t k) {
    const auto c = static_cast<Index>(k);
    Eigen::VectorXd signature = columns_.col(c).cast<double>();
    model.nuisances.Eliminate(signature.data());
    columns_.col(c) = signature.cast<float>();
  });
  ForgetProducts();
}

void SignatureBank::Fill(const CaseModel& model, std::size_t begin, std::size_t end,
                         const RecordSubset& look) {
  std::vector<EffectInstance> probes;
  for (std::size_t k = begin; k < end; ++k)
    probes.insert(probes.end(), entries_[k].group.probes.begin(), entries_[k].group.probes.end());
  const auto signatures = Signatures(model, *entries_[begin].base, probes, &look);
  for (std::size_t k = 0; k < signatures.size(); ++k) {
    if (signatures[k].empty()) continue;  // the rotor is lost there: nothing known of these rows
    columns_.col(entries_[begin].first + static_cast<Index>(k)) +=
        Eigen::Map<const Eigen::VectorXf>(signatures[k].data(), static_cast<Index>(model.size()));
  }
}

bool SignatureBank::partial() const {
  return look_ && std::count(look_->records.begin(), look_->records.end(), 0) > 0;
}

bool SignatureBank::LacksHalfOf(const RecordSubset& look) const {
  std::size_t all = 0, lacking = 0;
  for (std::size_t r = 0; r < look.records.size(); ++r) {
    if (!look.records[r]) continue;
    ++all;
    if (!LooksAt(r)) ++lacking;
  }
  return 2 * lacking >= all;
}

Eigen::VectorXd SignatureBank::Sum(const Entry& entry, const Eigen::VectorXd& amount) const {
  return (columns_.middleCols(entry.first, entry.count()) * amount.cast<float>()).cast<double>();
}

bool SignatureBank::Holds(const EffectInstance& probe) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) {
    const EffectInstance& o = e.group.probes[0];
    return IsSameName(o, probe) && o.values == probe.values;
  });
}

const Gram& SignatureBank::Products(const CaseModel& model) {
  if (multiplied_ == used_) return products_;
  // All columns by the new ones.
  const Index n = used_ - multiplied_;
  Gram fresh = Gram::Zero(model, used_, n);
  AddProducts(RowBlocks(model), &fresh, [&](const Span& s) {
    const Eigen::MatrixXf part = columns_.block(s.first, 0, s.count, used_).transpose() *
                                 columns_.block(s.first, multiplied_, s.count, n);
    return Eigen::MatrixXd(part.cast<double>());
  });
  for (const auto part : {&Gram::fit, &Gram::validate, &Gram::fit_points, &Gram::validate_points}) {
    if ((fresh.*part).size() == 0) continue;
    Eigen::MatrixXd& all = products_.*part;
    all.conservativeResize(used_, used_);
    all.rightCols(n) = fresh.*part;
    all.bottomLeftCorner(n, multiplied_) = all.topRightCorner(multiplied_, n).transpose();
  }
  multiplied_ = used_;
  return products_;
}

Gram SignatureBank::ProductsWith(const CaseModel& model, const Eigen::MatrixXd& a) const {
  Gram g = Gram::Zero(model, a.cols(), used_);
  AddProducts(RowBlocks(model), &g, [&](const Span& s) -> Eigen::MatrixXd {
    return a.middleRows(s.first, s.count).transpose() *
           columns_.block(s.first, 0, s.count, used_).cast<double>();
  });
  return g;
}

}  // namespace ambrig
