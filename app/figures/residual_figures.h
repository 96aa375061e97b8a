#pragma once
/// Figures of measured against model: time, error, its spectrum over the noise, its whiteness.
#include "app/figures/figure.h"
#include "app/figures/residual_data.h"

namespace ambrig {

/// A model's output under the name that the legend gives it.
struct NamedPrediction {
  std::string name, color;
  const std::vector<double>* values;
};

/// A column per channel; rows: whole record, the stretch where the first model errs most, errors
/// with the band of twice the noise.
Figure TimeFigure(const CaseModel& model, const std::vector<Target>& channels,
                  const std::vector<NamedPrediction>& predictions, const std::string& caption);

/// Amplitude density of the errors over the noise's own (`noise` may be empty), a column per
/// channel.
Figure SpectrumFigure(const CaseModel& model, const std::vector<Target>& channels,
                      const std::vector<NamedPrediction>& predictions,
                      const std::vector<double>& noise, const std::string& caption);

/// Autocorrelation of the errors beside the noise's own: what noise alone does not do is structure.
Figure WhitenessFigure(const CaseModel& model, const std::vector<Target>& channels,
                       const std::vector<NamedPrediction>& predictions,
                       const std::vector<double>& noise, const std::string& caption);

/// What each prediction adds to the first one, over the first one's error: signatures.
Figure SignatureFigure(const CaseModel& model, const Target& channel,
                       const std::vector<NamedPrediction>& predictions, const std::string& caption);

}  // namespace ambrig
