// Figures of measured against model from measurements that are written down: an offset stands in
// the time panels at its size, in the spectrum above the noise, and is no white noise.
#include "app/figures/residual_figures.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/math/constants.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

/// Readings of A.x in record 2 are 3 µm off; the noise is 0.2 µm.
class ResidualFigures : public ::testing::Test {
 protected:
  ResidualFigures()
      : case_(MeasuredCase({{2e-5, 1e-5}, {-4e-5, 3e-5, 1, 3e-6}, {1e-5, 1e-5}})), model_(case_) {
    for (Target& t : model_.targets()) t.floor = 2e-7;
    truth_.resize(model_.size());
    for (const Target& t : model_.targets()) {
      const double at[3][4] = {
          {2e-5, 1e-5, 2e-5, 1e-5}, {-4e-5, 3e-5, -4e-5, 3e-5}, {1e-5, 1e-5, 1e-5, 1e-5}};
      for (std::size_t k = 0; k < t.count; ++k) truth_[t.first + k] = at[t.record][t.channel];
    }
    mended_ = truth_;
    const Target& off = Off();
    for (std::size_t k = 0; k < off.count; ++k) mended_[off.first + k] += 3e-6;
  }
  const Target& Off() const { return model_.targets()[4]; }   // A.x of record 2
  const Target& Fine() const { return model_.targets()[0]; }  // A.x of record 1
  std::vector<NamedPrediction> Both() const {
    return {{"rig file", "@orange", &truth_}, {"with the offset", "@blue", &mended_}};
  }
  /// The trace of this name in a panel.
  static const nlohmann::json* Find(const Figure& f, const std::string& name, int panel) {
    for (const auto& trace : f.traces)
      if (trace["name"] == name && trace["xaxis"] == XRef(panel)) return &trace;
    return nullptr;
  }
  static double Mean(const nlohmann::json& values) {
    double sum = 0;
    for (const auto& v : values) sum += v.get<double>();
    return sum / static_cast<double>(values.size());
  }
  Case case_;
  CaseModel model_;
  std::vector<double> truth_, mended_;
};

// Three rows: all of it, where it errs most, the errors with the band of twice the noise.
TEST_F(ResidualFigures, TimeShowsTheErrorAtItsSize) {
  const Figure f = TimeFigure(model_, {Off()}, Both(), "caption");
  EXPECT_EQ(f.panels, 3);
  const auto* measured = Find(f, "measured", 0);
  const auto* error = Find(f, "rig file", 2);
  const auto* mended = Find(f, "with the offset", 2);
  ASSERT_TRUE(measured && error && mended);
  EXPECT_THAT(f.layout["yaxis"]["title"]["text"].get<std::string>(), HasSubstr("A.x [µm]"));
  EXPECT_THAT(f.layout["yaxis3"]["title"]["text"].get<std::string>(), HasSubstr("error [µm]"));
  EXPECT_NEAR(Mean((*measured)["y"]), -37, 0.1);
  EXPECT_NEAR(Mean((*error)["y"]), 3, 0.1);
  EXPECT_NEAR(Mean((*mended)["y"]), 0, 0.1);
  bool band = false;
  for (const auto& trace : f.traces)
    if (trace.value("name", "") == "twice the noise") {
      band = true;
      for (const auto& y : trace["y"]) EXPECT_NEAR(std::abs(y.get<double>()), 0.4, 1e-6);
    }
  EXPECT_TRUE(band);
  EXPECT_THAT(f.layout["annotations"][0]["text"].get<std::string>(), HasSubstr("A.x, record-2"));
}

TEST_F(ResidualFigures, EveryChannelHasItsColumnAndOneLegendServesAll) {
  const Figure f = TimeFigure(model_, {Off(), Fine()}, Both(), "caption");
  EXPECT_EQ(f.panels, 6);
  int legends = 0;
  for (const auto& trace : f.traces)
    legends += trace["name"] == "measured" && trace["showlegend"].get<bool>() ? 1 : 0;
  EXPECT_EQ(legends, 1);
}

// A tone of 1 µm that the model has too much stands at its frequency alone; mended, only noise is
// left.
TEST_F(ResidualFigures, SpectrumStandsAboveTheNoiseWhereTheErrorIs) {
  std::vector<double> tone = mended_;
  for (std::size_t k = 0; k < Off().count; ++k)
    tone[Off().first + k] += 1e-6 * std::sin(2 * kPi * 625 * static_cast<double>(k) / 12500);
  const Figure f = SpectrumFigure(model_, {Off()},
                                  {{"tone", "@red", &tone}, {"with the offset", "@blue", &mended_}},
                                  {}, "caption");
  const auto* error = Find(f, "error of tone", 0);
  const auto* mended = Find(f, "error of with the offset", 0);
  const auto* noise = Find(f, "noise alone", 0);
  ASSERT_TRUE(error && mended && noise);
  EXPECT_THAT(f.layout["yaxis"]["title"]["text"].get<std::string>(), HasSubstr("m/√Hz]"));
  EXPECT_EQ(f.layout["xaxis"]["type"], "log");
  const double level = Mean((*noise)["y"]);
  EXPECT_NEAR(Mean((*mended)["y"]) / level, 1, 0.3);
  double above = 0, at = 0;
  for (std::size_t k = 0; k < (*error)["y"].size(); ++k)
    if (const double here = (*error)["y"][k]; here > above) {
      above = here;
      at = (*error)["x"][k];
    }
  EXPECT_NEAR(at, 625, 250);  // within a line of 400 rows in six segments
  EXPECT_GT(above, 4 * level);
  for (const auto& x : (*error)["x"]) EXPECT_LE(x.get<double>(), 6250.01);  // half of the rate
}

// An offset is the same in neighbouring rows, noise is not.
TEST_F(ResidualFigures, WhitenessTellsStructureFromNoise) {
  const Figure f = WhitenessFigure(model_, {Off()}, Both(), {}, "caption");
  const auto* error = Find(f, "error of rig file", 0);
  const auto* mended = Find(f, "error of with the offset", 0);
  ASSERT_TRUE(error && mended);
  EXPECT_NEAR((*error)["y"][0].get<double>(), 1, 1e-4);
  EXPECT_GT((*error)["y"][1].get<double>(), 0.9);
  EXPECT_LT(std::abs((*mended)["y"][1].get<double>()), 0.2);
  EXPECT_NEAR((*error)["x"][1].get<double>(), 1e3 / 12500, 1e-6);  // [ms]
  EXPECT_EQ(f.layout["xaxis"]["title"]["text"], "lag [ms]");
}

// What an effect adds, over the error that it should explain: here all of it.
TEST_F(ResidualFigures, ASignatureLiesOnTheErrorThatItExplains) {
  const Figure f = SignatureFigure(model_, Off(), Both(), "caption");
  EXPECT_EQ(f.panels, 1);
  const auto* residual = Find(f, "residual of the rig file's model", 0);
  const auto* added = Find(f, "best-ranked effect", 0);
  ASSERT_TRUE(residual && added);
  EXPECT_NEAR(Mean((*added)["y"]), 3, 1e-3);
  EXPECT_NEAR(Mean((*residual)["y"]), 3, 0.1);
  std::vector<NamedPrediction> three = Both();
  three.push_back({"nothing", "@gray", &truth_});
  const Figure two = SignatureFigure(model_, Off(), three, "caption");
  EXPECT_EQ(two.panels, 2);
  const auto* other = Find(two, "another candidate", 1);
  ASSERT_TRUE(other);
  EXPECT_EQ(Mean((*other)["y"]), 0);
}

TEST(Autocorrelations, OfAlternatingSigns) {
  const std::vector<double> a = Autocorrelation({1, -1, 1, -1}, 3);
  EXPECT_DOUBLE_EQ(a[0], 1);
  EXPECT_DOUBLE_EQ(a[1], -0.75);
  EXPECT_DOUBLE_EQ(a[2], 0.5);
}

TEST(ReportNames, Short) { EXPECT_EQ(ShortName("a/b.c/record-3.h5"), "record-3"); }

}  // namespace
}  // namespace ambrig
