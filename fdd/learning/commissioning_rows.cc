#include "fdd/learning/commissioning_rows.h"

#include <cmath>

namespace ambrig {

namespace {
constexpr double kBusError = 0.005;  // of the bus: what the model may miss
}

CommissioningRows::CommissioningRows(const LinkageModel& nominal, const SamplingSettings& sampling,
                                     const ExcessSettings& settings, const CommissioningLog& log)
    : nominal_(nominal), sampling_(sampling), log_(log) {
  FluxFilter filter(nominal, sampling, {});
  CoilEquations coils;  // of the nominal bearing: for the size of the noise
  Lane all;
  for (int j = 0; j < nominal.coils; ++j) {
    coils.gain[j] = all[j] = 1;
    coils.leakage[j] = nominal.leakage[j];
    coils.resistance[j] = nominal.resistance[j];
  }
  FluxPeriod period;
  SlopeExcess judged;
  const double bus = kBusError * sampling.amplifier->bus_voltage;
  for (std::size_t block = 0; (block + 1) * kAverage <= log.size(); ++block) {
    CommissioningRow sum[2][kLanes];
    bool holds[2][kLanes];
    for (auto& phase : holds)
      for (bool& one : phase) one = true;
    for (std::size_t k = 0; k < kAverage; ++k) {
      const MeasuredPeriod in = log.At(block * kAverage + k);
      filter.Period(in, &period);
      ComputeSlopeExcess(filter, coils, settings, period, all, &judged);
      for (int q = 0; q < 2; ++q)
        for (int j = 0; j < nominal.coils; ++j) {
          const FluxPhase& p = period.phase[q];
          holds[q][j] = holds[q][j] && in.comparable && !in.uncertainty.any() &&
                        judged.bottom[q][j] > 0 && !(judged.gross[j] > 0);
          const double own = filter.inductances()[j] * period.own[j] + nominal.leakage[j];
          sum[q][j].current += p.current[j] / kAverage;
          sum[q][j].mean += p.mean[j] / kAverage;
          sum[q][j].voltage += p.voltage[j] / kAverage;
          sum[q][j].weight += std::pow(own * settings.current_noise / kAverage, 2) * p.scale[j];
        }
    }
    for (int q = 0; q < 2; ++q)
      for (int j = 0; j < nominal.coils; ++j) {
        if (!holds[q][j]) continue;
        CommissioningRow row = sum[q][j];
        row.coil = j;
        row.weight = 1 / std::sqrt(row.weight + bus * bus);
        rows_.push_back(row);
        places_.push_back({block, q});
      }
  }
}

void CommissioningRows::FluxSlopes(const FluxCircuit& circuit, std::vector<double>* out) const {
  FluxFilter filter(nominal_, sampling_, circuit);
  FluxPeriod period;
  out->resize(rows_.size());
  std::size_t row = 0;
  for (std::size_t block = 0; (block + 1) * kAverage <= log_.size(); ++block) {
    Lane sum[2];
    for (std::size_t k = 0; k < kAverage; ++k) {
      filter.Period(log_.At(block * kAverage + k), &period);
      for (int q = 0; q < 2; ++q)
        for (int j = 0; j < kLanes; ++j) sum[q][j] += period.phase[q].flux[j] / kAverage;
    }
    for (; row < rows_.size() && places_[row].block == block; ++row)
      (*out)[row] = sum[places_[row].phase][rows_[row].coil];
  }
}

}  // namespace ambrig
