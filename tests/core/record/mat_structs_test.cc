// Structs of dSPACE and Simulink as scipy writes them (make_instruments.py).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "core/record/column_names.h"
#include "core/record/mat.h"
#include "tests/core/record/formats/instrument_files.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using testing::ErrorText;
using ::testing::HasSubstr;
using testing::InstrumentFile;
using testing::SignalX;
using testing::SignalY;
using ::testing::StartsWith;

TEST(MatStructs, DspaceBringsNamesUnitsAndTime) {
  const Record r = ReadMat(InstrumentFile("mat_dspace.mat"));
  EXPECT_EQ(r.rate, 1000);
  EXPECT_EQ(r.start, 0);
  ASSERT_EQ(r.channels.size(), 2U);
  EXPECT_EQ(r.channels[0].name, "A.x");
  EXPECT_EQ(r.channels[0].unit, "um");
  EXPECT_EQ(r.channels[0].samples, SignalX());
  EXPECT_EQ(r.channels[1].name, "A.i1");
  EXPECT_EQ(r.channels[1].samples, SignalY());
  EXPECT_THAT(r.notes, ElementsAre(HasSubstr("slow has 4 rows at 10 Hz from 0 s on")));
  // By the name that ControlDesk shows.
  EXPECT_EQ(FindColumn(r, "\"Model Root\"/\"AMB\"/\"A.x\""), &r.channels[0]);
}

TEST(MatStructs, SimulinkStructureWithTime) {
  const Record r = ReadMat(InstrumentFile("mat_simulink.mat"));
  EXPECT_EQ(r.rate, 1000);
  ASSERT_EQ(r.channels.size(), 4U);
  EXPECT_EQ(r.Find("A.x")->samples, SignalX());
  EXPECT_EQ(r.Find("simout.signals(2)(1)")->samples, SignalY());
  EXPECT_EQ(r.Find("simout.signals(2)(2)")->samples, SignalX());
  EXPECT_EQ(r.Find("load")->samples, SignalY());  // a vector beside it; tout is its time
}

TEST(MatStructs, TimeseriesAsAStruct) {
  const Record r = ReadMat(InstrumentFile("mat_timeseries_struct.mat"));
  EXPECT_EQ(r.rate, 1000);
  EXPECT_EQ(r.Find("ts")->samples, SignalY());
  EXPECT_EQ(r.Find("deep")->samples, SignalX());  // 1 x 1 x rows
}

TEST(MatStructs, ObjectsOfMatlabSayTheWayRound) {
  const std::string path = InstrumentFile("mat_object.mat");
  EXPECT_THAT(ErrorText<InputError>([&] { ReadMat(path); }),
              AllOf(StartsWith(path + ": "), HasSubstr("object of MATLAB (timeseries"),
                    HasSubstr("s.Time = ts.Time; s.Data = ts.Data")));
  // Beside an object, whatever stands behind it is read.
  const Record r = ReadMat(InstrumentFile("mat_object_beside.mat"));
  ASSERT_EQ(r.channels.size(), 1U);
  EXPECT_THAT(r.Find("A.x")->samples, ElementsAre(1, 2, 3));
  EXPECT_THAT(r.notes, ElementsAre(HasSubstr("object of MATLAB")));
}

}  // namespace
}  // namespace ambrig
