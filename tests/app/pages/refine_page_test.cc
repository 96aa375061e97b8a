// Words of `ambrig refine` about a curve that is written down.
#include "app/pages/refine_report.h"

#include <gtest/gtest.h>

namespace ambrig {
namespace {

Refinement Supported(double lo, double hi) {
  Refinement r;
  r.shape.u_name = "flux density of the pole";
  r.shape.u_unit = "T";
  r.supported_lo = lo;
  r.supported_hi = hi;
  return r;
}

TEST(SupportText, IsARangeOrNowhere) {
  EXPECT_EQ(SupportText(Supported(0.1, 0.85)),
            "supported for flux density of the pole = 100\u00a0mT to 850\u00a0mT only");
  EXPECT_EQ(SupportText(Supported(0, 0)), "supported nowhere by these records");
  Refinement whole = Supported(0, 1.2);
  whole.shape.u = {0, 0.6, 1.2};
  EXPECT_EQ(SupportText(whole), "supported at every flux density of the pole");
}

}  // namespace
}  // namespace ambrig
