#pragma once
/// Cases whose record is a frequency response, and sines in the switching engine beside them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <complex>
#include <string>
#include <vector>

#include "discovery/model/multisine_response.h"
#include "discovery/model/response_predictor.h"
#include "effects/catalogue.h"
#include "tests/discovery/bench_case.h"

namespace ambrig::testing {

/// A file of responses at these frequencies; what stands in it plays no part here.
inline std::string Trace(const TemporaryFolder& folder, const std::vector<double>& frequencies) {
  std::string text = "f [Hz],Re(trace),Im(trace)\n";
  for (const double f : frequencies) text += fmt::format("{},1,0\n", f);
  WriteBytes(folder.File("trace.csv"), text);
  return "trace.csv";
}

inline EffectInstance With(const std::string& effect, const std::string& target,
                           const std::string& parameter, double value) {
  EffectInstance e = MakeInstance(EffectNamed(effect), target);
  e.Set(parameter, value);
  return e;
}

inline constexpr double kNear =
    0.02;  // as the linear model against sines, docs/theory/linearisation.md

/// What a small force on A.x does to the reading and to the set-points of that axis.
struct MeasuredAxis {
  std::complex<double> compliance, set_point;
};

inline MeasuredAxis SinesOf(const RigParameters& rig, double f, double amplitude) {
  SineRun run{rig, {}};
  run.sine.target = "A.x";
  run.sine.port = "force";
  run.sine.frequency = f;
  run.sine.amplitude = amplitude;
  return {run.Response({{"A.x", 1}}), run.Response({{"A.s1", 1}})};
}

inline void ExpectNearSines(const RigParameters& rig, const Case& c) {
  const ResponsePredictor predictor(c, c.records[0]);
  const auto H = predictor.Respond(rig);
  ASSERT_EQ(H.size(), 2u);
  const auto &set_point = H[0], &reading = H[1];  // by name: A.s1 before A.x
  const std::vector<double>& f = c.records[0].responses.frequency;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const MeasuredAxis measured = SinesOf(rig, f[k], 0.1);
    EXPECT_LT(std::abs(reading[k] - measured.compliance), kNear * std::abs(reading[k]))
        << f[k] << " Hz: " << reading[k] << " measured " << measured.compliance;
    EXPECT_LT(std::abs(set_point[k] - measured.set_point), kNear * std::abs(set_point[k]))
        << f[k] << " Hz: " << set_point[k] << " measured " << measured.set_point;
  }
}

inline Case AxisCase(const TemporaryFolder& folder, const std::vector<double>& frequencies) {
  const std::string file = Trace(folder, frequencies);
  return CaseOf(folder,
                "[[record]]\nkind = \"frf\"\ndata = \"" + file +
                    "\"\n[record.responses]\n\"A.x/A.x.force\" = { trace = \"trace\", unit = "
                    "\"m/N\" }\n\"A.s1/A.x.force\" = { trace = \"trace\", unit = \"A/N\" }\n");
}

}  // namespace ambrig::testing
