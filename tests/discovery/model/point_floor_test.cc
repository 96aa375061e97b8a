// How far points scatter whose sd nobody states: the white part of what the model leaves.
#include "discovery/model/point_floor.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/math/noise.h"
#include "tests/discovery/bench_case.h"

namespace ambrig {
namespace {

using testing::CaseOf;
using testing::TemporaryFolder;
using testing::WriteBytes;

// Real and imaginary part scatter by 0.02 about the prediction; an error that changes slowly is
// none of the scatter.
TEST(PointFloor, IsTheScatterAboutThePrediction) {
  const TemporaryFolder folder;
  std::string text = "f [Hz],Re(trace),Im(trace)\n";
  for (int k = 0; k < 301; ++k) text += fmt::format("{},1,0.5\n", 20 + k);
  WriteBytes(folder.File("trace.csv"), text);
  const std::string record = "[[record]]\nkind = \"frf\"\ndata = \"trace.csv\"\n",
                    response = "[record.responses]\n\"A.x.command/A.x.force\" = \"trace\"\n";
  const Case open = CaseOf(folder, record + response);
  const CaseModel model(open);
  std::vector<double> predicted = model.measured();
  for (std::size_t k = 0; k < predicted.size(); ++k)
    predicted[k] -= 0.02 * Normal(5, 1, k) + 0.1 + 1e-4 * static_cast<double>(k % 301);
  EXPECT_NEAR(PointFloor(model, 0, predicted), 0.02, 0.003);
  EXPECT_EQ(PointFloor(model, 0, predicted), PointFloor(model, 1, predicted));
  const Case known = CaseOf(folder, record + "sd = 0.03\n" + response);
  const CaseModel stated(known);
  EXPECT_EQ(PointFloor(stated, 0, predicted), 1);  // in units of what is stated
}

}  // namespace
}  // namespace ambrig
