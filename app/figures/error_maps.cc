// Errors of all records in one picture: over frequency and speed, over position, current and speed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/ratio_figure.h"
#include "app/figures/response_figures.h"
#include "app/figures/series.h"
#include "core/math/constants.h"
#include "core/math/fft.h"
#include "core/record/channels.h"

namespace ambrig {
namespace {

const std::vector<double> kEdges = {0, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 1e4, 1e6};

std::string BandName(std::size_t band) {
  const auto text = [](double f) {
    return f < 1000 ? fmt::format("{:g}", f) : fmt::format("{:g}k", f / 1000);
  };
  if (band + 2 == kEdges.size()) return "> " + text(kEdges[band]);
  return text(kEdges[band]) + "–" + text(kEdges[band + 1]);
}

/// Rows of a record in which the speed is about one.
struct RecordSlice {
  std::string name;
  std::size_t record, first, last;
};

std::vector<RecordSlice> RecordSlices(const CaseModel& model) {
  std::vector<RecordSlice> out;
  for (std::size_t r = 0; r < model.data().records.size(); ++r) {
    const CaseRecord& record = model.data().records[r];
    if (!OverTime(record)) continue;
    const std::size_t rows = record.data.rows();
    const auto hertz = [&](std::size_t row) {
      return record.scenario.speed.Speed(record.data.TimeAt(row)) / kTurn;
    };
    if (rows < 64) continue;
    const bool runs_up = std::abs(hertz(rows - 1) - hertz(0)) > 10;
    const std::size_t parts = runs_up ? 5 : 1;
    for (std::size_t p = 0; p < parts; ++p) {
      const std::size_t first = rows * p / parts, last = rows * (p + 1) / parts;
      const std::string speed = runs_up
                                    ? fmt::format("{:.0f}–{:.0f} Hz", hertz(first), hertz(last - 1))
                                : std::abs(hertz(0)) < 0.5 ? std::string("at rest")
                                                           : fmt::format("{:.0f} Hz", hertz(0));
      out.push_back({ShortName(record.data_file) + ", " + speed, r, first, last});
    }
  }
  return out;
}

/// The largest length up to n, at least 16, whose prime factors are 2, 3 and 5: the transform of
/// any other takes steps in proportion to its largest factor.
std::size_t FastLength(std::size_t n) {
  for (; n > 16; --n) {
    std::size_t rest = n;
    for (const std::size_t factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return n;
  }
  return 16;
}

/// Power of x in each band; NaN where the length has no line in it.
std::vector<double> BandPower(const std::vector<double>& x, double rate) {
  const PowerDensity p = WelchPsd(x, rate, FastLength(x.size() / 2));
  std::vector<double> out(kEdges.size() - 1, std::nan(""));
  for (std::size_t k = 1; k < p.frequency.size(); ++k) {
    const auto band = static_cast<std::size_t>(std::ranges::upper_bound(kEdges, p.frequency[k]) -
                                               kEdges.begin()) -
                      1;
    out[band] = (std::isnan(out[band]) ? 0 : out[band]) + p.density[k];
  }
  return out;
}

std::vector<double> CutToSlice(const std::vector<double>& flat, const Target& t,
                               const RecordSlice& s) {
  const auto begin = flat.begin() + static_cast<std::ptrdiff_t>(t.first);
  return {begin + static_cast<std::ptrdiff_t>(s.first),
          begin + static_cast<std::ptrdiff_t>(s.last)};
}

std::vector<double> BandRatios(const CaseModel& model, const std::vector<double>& residual,
                               const std::vector<double>& noise, const RecordSlice& s) {
  std::vector<double> sum(kEdges.size() - 1, 0), out(sum.size(), std::nan(""));
  double channels = 0;
  const double rate = model.data().records[s.record].data.rate;
  for (const Target& t : model.targets()) {
    if (t.record != s.record) continue;
    const std::vector<double> error = BandPower(CutToSlice(residual, t, s), rate),
                              floor = BandPower(CutToSlice(noise, t, s), rate);
    // Noise may leave a band nearly empty; what is lost beside its whole power is no yardstick.
    double least = 0;
    for (const double power : floor) least += std::isfinite(power) ? 1e-4 * power : 0;
    for (std::size_t b = 0; b < sum.size(); ++b)
      sum[b] += error[b] * t.floor * t.floor / std::max(floor[b], least);
    channels += 1;
  }
  for (std::size_t b = 0; b < sum.size(); ++b)
    if (channels > 0 && std::isfinite(sum[b])) out[b] = std::sqrt(sum[b] / channels);
  return out;
}

}  // namespace

std::optional<Figure> FrequencySpeedMap(const CaseModel& model,
                                        const std::vector<double>& predicted,
                                        const std::vector<double>& noise,
                                        const std::string& caption) {
  if (noise.empty()) return {};
  const std::vector<double> residual = Residual(model, predicted);
  std::vector<std::string> rows, columns;
  std::vector<std::vector<double>> values;
  for (const RecordSlice& s : RecordSlices(model)) {
    rows.push_back(s.name);
    values.push_back(BandRatios(model, residual, noise, s));
  }
  if (rows.empty()) return {};
  std::size_t used = 0;
  for (const auto& row : values)
    for (std::size_t b = 0; b < row.size(); ++b)
      if (std::isfinite(row[b])) used = std::max(used, b + 1);
  for (auto& row : values) row.resize(used);
  for (std::size_t b = 0; b < used; ++b) columns.push_back(BandName(b) + " Hz");
  return RatioFigure(columns, rows, values, caption);
}

namespace {

// ---- dependence

struct Binned {
  std::string on, unit;
  std::vector<double> at, mean, low, high;
  double share = 0;  // of the error's power that the means explain
};

constexpr std::size_t kBins = 24;

Binned BinOver(const std::string& on, const std::string& unit, const std::vector<double>& x,
               const std::vector<double>& e) {
  Binned out{on, unit, {}, {}, {}, {}, 0};
  std::vector<double> sorted;
  for (const double v : x)
    if (std::isfinite(v)) sorted.push_back(v);
  if (sorted.size() < 10 * kBins) return out;
  std::ranges::sort(sorted);
  const double lo = sorted[sorted.size() / 200],
               hi = sorted[sorted.size() - 1 - sorted.size() / 200];
  if (!(hi > lo)) return out;
  std::vector<double> n(kBins, 0), sum(kBins, 0), square(kBins, 0);
  double total = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!std::isfinite(x[k]) || !std::isfinite(e[k])) continue;
    total += e[k] * e[k];
    if (x[k] < lo || x[k] > hi) continue;
    const auto b = std::min(kBins - 1, static_cast<std::size_t>((x[k] - lo) / (hi - lo) * kBins));
    n[b] += 1;
    sum[b] += e[k];
    square[b] += e[k] * e[k];
  }
  for (std::size_t b = 0; b < kBins; ++b) {
    if (n[b] < 10) continue;
    const double mean = sum[b] / n[b],
                 sd = std::sqrt(std::max(0.0, square[b] / n[b] - mean * mean));
    out.at.push_back(lo + (static_cast<double>(b) + 0.5) * (hi - lo) / kBins);
    out.mean.push_back(mean);
    out.low.push_back(mean - sd);
    out.high.push_back(mean + sd);
    out.share += total > 0 ? n[b] * mean * mean / total : 0;
  }
  return out;
}

/// Errors of a channel in all records, and the other measured series beside them.
class Pool {
 public:
  Pool(const CaseModel& model, const std::vector<double>& predicted, const std::string& channel)
      : model_(model) {
    for (const Target& t : model.targets()) {
      if (ChannelName(model, t) != channel) continue;
      records_.push_back(t.record);
      const std::vector<double> r = ViewOf(model, predicted, t).residual;
      error_.insert(error_.end(), r.begin(), r.end());
      unit_ = model.data().records[t.record].data.channels[t.channel].unit;
    }
  }

  const std::vector<double>& error() const { return error_; }
  const std::string& unit() const { return unit_; }

  /// NaN in records that lack the channel.
  std::vector<double> Series(const std::string& name) const {
    std::vector<double> out;
    for (const std::size_t r : records_) {
      const Record& data = model_.data().records[r].data;
      const Channel* c = data.Find(name);
      for (std::size_t k = 0; k < data.rows(); ++k) out.push_back(c ? c->samples[k] : std::nan(""));
    }
    return out;
  }

  std::vector<double> Speed() const {
    std::vector<double> out;
    for (const std::size_t r : records_) {
      const CaseRecord& record = model_.data().records[r];
      for (std::size_t k = 0; k < record.data.rows(); ++k)
        out.push_back(record.scenario.speed.Speed(record.data.TimeAt(k)) / kTurn);
    }
    return out;
  }

  /// Names of one kind at the channel's bearing (or anywhere, for a channel of the whole rig).
  std::vector<std::string> Names(ChannelKind kind, const std::string& of) const {
    const auto about = ParseChannel(of);
    std::vector<std::string> out;
    for (const std::size_t r : records_)
      for (const Channel& c : model_.data().records[r].data.channels) {
        const auto id = ParseChannel(c.name);
        if (!id || id->kind != kind) continue;
        const bool here =
            !about || about->row().scope == ChannelScope::kRig || id->plane == about->plane;
        if (here && std::ranges::find(out, c.name) == out.end()) out.push_back(c.name);
      }
    return out;
  }

 private:
  const CaseModel& model_;
  std::vector<std::size_t> records_;
  std::vector<double> error_;
  std::string unit_;
};

Binned BestOf(const Pool& pool, ChannelKind kind, const std::string& channel) {
  Binned best;
  const std::string unit(RowOf(kind).unit);
  for (const std::string& name : pool.Names(kind, channel)) {
    Binned b = BinOver(name, unit, pool.Series(name), pool.error());
    if (best.at.empty() || b.share > best.share) best = std::move(b);
  }
  return best;
}

}  // namespace

std::optional<Figure> DependenceFigure(const CaseModel& model, const std::vector<double>& predicted,
                                       const std::string& channel) {
  const Pool pool(model, predicted, channel);
  std::vector<Binned> all = {BestOf(pool, ChannelKind::kReading, channel),
                             BestOf(pool, ChannelKind::kCoilCurrent, channel),
                             BinOver("speed", "Hz", pool.Speed(), pool.error())};
  std::erase_if(all, [](const Binned& b) { return b.at.size() < 2; });
  if (all.empty()) return {};
  Grid grid;
  grid.columns = static_cast<int>(all.size());
  grid.shared_x = false;
  grid.panel_height = 220;
  for (const Binned& b : all)
    grid.titles.push_back(fmt::format("against {}: explains {:.0f} %", b.on, 100 * b.share));
  Figure figure = MakeFigure(
      fmt::format("Error of {} (all its records together) against measured position, current and "
                  "speed: mean in each bin, shade one standard deviation. A flat line at zero "
                  "means that the error is independent of that quantity.",
                  channel),
      grid);
  double largest = 0;
  for (const Binned& b : all)
    largest = std::max({largest, LargestSize(b.low), LargestSize(b.high)});
  const DisplayUnit y = ChooseUnit(largest, pool.unit());
  for (int p = 0; p < static_cast<int>(all.size()); ++p) {
    const Binned& b = all[static_cast<std::size_t>(p)];
    const DisplayUnit x =
        b.unit == "Hz" ? DisplayUnit{1, "Hz"} : ChooseUnit(LargestSize(b.at), b.unit);
    const std::vector<double> at = Scaled(b.at, x.factor);
    AddBand(figure, p, "one sd", at, Scaled(b.low, y.factor), Scaled(b.high, y.factor), "@blue");
    figure.traces.back()["showlegend"] = p == 0;
    Style style;
    style.color = "@blue";
    style.legend = p == 0;
    AddLine(figure, p, "mean error", at, Scaled(b.mean, y.factor), style);
    SetAxes(figure, p, fmt::format("{} [{}]", b.on, x.name),
            p == 0 ? fmt::format("error of {} [{}]", channel, y.name) : "");
  }
  return figure;
}

}  // namespace ambrig
