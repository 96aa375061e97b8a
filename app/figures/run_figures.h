#pragma once
/// The figures of a run's report, one function each (run_data.h has the data).
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/figures/figure.h"
#include "app/figures/run_data.h"

namespace ambrig {

/// Where the run is cut for pictures: times of the first fault and of the last reaction to it.
struct RunStages {
  std::optional<double> fault, reaction;  // [s]
  std::string coil;                       // the first faulty one
  std::set<std::string> coils;            // all that a fault names
  std::array<double, 2> whole{};          // [s]
  std::array<double, 2> window{};         // round the fault, [s]
};
RunStages FindStages(const RunReportData& data);

/// A mark per event, at `factor` (t - t0).
std::vector<Mark> EventMarks(const RunReportData& data, double t0 = 0, double factor = 1);

Figure OrbitFigure(const RunReportData& data, const RunStages& stages);
/// `range` in s; `zoom` counts time from the fault in ms.
Figure PositionFigure(const RunReportData& data, const RunStages& stages, bool zoom);
Figure CurrentFigure(const RunReportData& data, const RunStages& stages, bool zoom);
Figure ChannelFigure(const RunReportData& data);
/// The faulty coil's current with its three stages: figures 12 and 17 of the paper.
std::optional<Figure> StageFigure(const RunReportData& data, const RunStages& stages);
/// ADC samples at each stage: figures 13 and 18.
Figure SampleFigure(const RunReportData& data);
/// Slope against its expected band, with the detector's flag below: figures 14, 15, 19, 20.
Figure SlopeFigure(const ReportSlope& slope, const RunReportData& data, const RunStages& stages);
/// Slope minus the band's middle before the fault: figure 11.
std::optional<Figure> SlopeHistogram(const ReportSlope& slope, const RunStages& stages);
/// Small multiples of all coils.
Figure SlopeGrid(const RunReportData& data, const RunStages& stages);
Figure SnapshotFigure(const RunReportData& data);

}  // namespace ambrig
