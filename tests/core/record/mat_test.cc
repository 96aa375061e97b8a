#include "core/record/mat.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <matio.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdint>

#include "core/base/errors.h"
#include "core/record/hdf5.h"
#include "core/record/read_record.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using testing::ErrorText;
using testing::ReadBytes;
using testing::TemporaryFolder;
using testing::WriteBytes;

Record MatExample() {
  return {12500.0, 0.125, {{"A.x", "um", {0.1, 1.0 / 3, -2}}, {"bus", "", {1, 2, 3}}}};
}

template <class T>
matvar_t* Array(const char* name, matio_classes kind, matio_types type, std::vector<T> data,
                bool row = false) {
  std::size_t dims[2] = {data.size(), 1};
  if (row) std::swap(dims[0], dims[1]);
  return Mat_VarCreate(name, kind, type, 2, dims, data.data(), 0);
}

matvar_t* Doubles(const char* name, const std::vector<double>& data) {
  return Array(name, MAT_C_DOUBLE, MAT_T_DOUBLE, data);
}

/// A file as other programs write it: numbers of many kinds, a struct, a text.
void WriteForeign(const std::string& path, mat_ft version, matio_compression compression) {
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
  const auto put = [&](matvar_t* v) {
    ASSERT_EQ(Mat_VarWrite(file, v, compression), 0);
    Mat_VarFree(v);
  };
  put(Array<float>("A_x", MAT_C_SINGLE, MAT_T_SINGLE, {1.5F, -2.5F, 3.5F}));
  put(Array<std::int16_t>("omega", MAT_C_INT16, MAT_T_INT16, {-7, 0, 32767}, true));
  put(Array<std::uint8_t>("pos_ax", MAT_C_UINT8, MAT_T_UINT8, {0, 255, 3}));
  const char* fields[] = {"x", "y"};
  std::size_t one[2] = {1, 1}, text[2] = {1, 5};
  matvar_t* b = Mat_VarCreateStruct("B", 2, one, fields, 2);
  Mat_VarSetStructFieldByName(b, "x", 0, Doubles(nullptr, {1, 2, 3}));
  Mat_VarSetStructFieldByName(b, "y", 0, Doubles(nullptr, {4, 5, 6}));
  put(b);
  char hello[] = "hello";
  put(Mat_VarCreate("comment", MAT_C_CHAR, MAT_T_UINT8, 2, text, hello, 0));
  put(Doubles("rate", {1000}));
  put(Doubles("other", {5}));
  Mat_Close(file);
}

void ExpectForeign(const std::string& path) {
  const Record r = ReadMat(path);
  EXPECT_EQ(r.rate, 1000.0);
  EXPECT_EQ(r.start, 0.0);
  ASSERT_NE(r.Find("A.x"), nullptr);
  EXPECT_THAT(r.Find("A.x")->samples, ElementsAre(1.5, -2.5, 3.5));
  EXPECT_THAT(r.Find("omega")->samples, ElementsAre(-7, 0, 32767));
  EXPECT_THAT(r.Find("pos_ax")->samples, ElementsAre(0, 255, 3));
  EXPECT_THAT(r.Find("B.y")->samples, ElementsAre(4, 5, 6));
  EXPECT_EQ(r.channels.size(), 5u);
  EXPECT_THAT(r.notes, ::testing::UnorderedElementsAre(
                           EndsWith("comment is not a vector of numbers, left out"),
                           EndsWith("other is a single number, left out")));
}

TEST(Mat, ReadsVersion5PlainAndCompressedAndVersion73) {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.mat");
  WriteForeign(path, MAT_FT_MAT5, MAT_COMPRESSION_NONE);
  ExpectForeign(path);
  WriteForeign(path, MAT_FT_MAT5, MAT_COMPRESSION_ZLIB);
  ExpectForeign(path);
  WriteForeign(path, MAT_FT_MAT73, MAT_COMPRESSION_NONE);
  ExpectForeign(path);
  EXPECT_EQ(ReadRecord(path).rate, 1000.0);
}

TEST(Mat, WritesWhatItReads) {
  const TemporaryFolder folder;
  const Record r = MatExample();
  WriteMat(r, folder.File("a.mat"));
  const Record back = ReadMat(folder.File("a.mat"));
  EXPECT_EQ(back.rate, r.rate);
  EXPECT_EQ(back.start, r.start);
  ASSERT_EQ(back.channels.size(), 2u);
  for (int c : {0, 1}) {
    EXPECT_EQ(back.channels[c].name, r.channels[c].name);
    EXPECT_EQ(back.channels[c].unit, r.channels[c].unit);
    EXPECT_EQ(back.channels[c].samples, r.channels[c].samples);
  }
  EXPECT_TRUE(back.notes.empty());
  EXPECT_THAT(folder.Names(), ElementsAre("a.mat"));
}

TEST(Mat, SameRecordSameBytes) {
  const TemporaryFolder folder;
  WriteMat(MatExample(), folder.File("a.mat"));
  const std::string bytes = ReadBytes(folder.File("a.mat"));
  WriteMat(MatExample(), folder.File("a.mat"));
  EXPECT_EQ(ReadBytes(folder.File("a.mat")), bytes);
  EXPECT_EQ(bytes.find("20", 0), bytes.find("20", 116));  // no year in the header's text
}

TEST(Mat, VectorOfTimesInsteadOfARate) {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.mat");
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
  matvar_t *t = Doubles("t", {1, 1.5, 2}), *z = Doubles("z", {4, 5, 6});
  Mat_VarWrite(file, t, MAT_COMPRESSION_NONE);
  Mat_VarWrite(file, z, MAT_COMPRESSION_NONE);
  Mat_VarFree(t);
  Mat_VarFree(z);
  Mat_Close(file);
  const Record r = ReadMat(path);
  EXPECT_EQ(r.rate, 2.0);
  EXPECT_EQ(r.start, 1.0);
  EXPECT_EQ(r.channels.size(), 1u);
}

// As h5py writes it: the head of version 7.3 before plain HDF5.
TEST(Mat, Version73WithoutClassesOfMatlab) {
  const TemporaryFolder folder;
  WriteHdf5({1000.0, 0.5, {{"A_x", "um", {1, 2, 3}}, {"bus", "V", {4, 5, 6}}}},
            folder.File("a.h5"));
  std::string head = "MATLAB 7.3 MAT-file, Platform: python";
  head.resize(124, ' ');
  head += std::string("\0\2IM", 4);
  head.resize(512, '\0');
  WriteBytes(folder.File("a.mat"), head + ReadBytes(folder.File("a.h5")));
  const Record r = ReadMat(folder.File("a.mat"));
  EXPECT_EQ(r.rate, 1000.0);
  EXPECT_EQ(r.start, 0.5);
  ASSERT_NE(r.Find("A.x"), nullptr);
  EXPECT_EQ(r.Find("A.x")->unit, "um");
  EXPECT_THAT(r.Find("bus")->samples, ElementsAre(4, 5, 6));
}

// Written by the library's own split form: two arrays of one variable.
TEST(Mat, ComplexVectorsAreFrequencyResponses) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const TemporaryFolder folder;
    const std::string path = folder.File("a.mat");
    mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
    double re[] = {1, 0.5, -2}, im[] = {0, -1, 3};
    mat_complex_split_t parts{re, im};
    std::size_t dims[] = {3, 1};
    matvar_t* all[] = {
        Mat_VarCreate("S_ax", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, &parts, MAT_F_COMPLEX),
        Doubles("freq", {10, 20, 40}), Doubles("S_ax_coherence", {1, 0.5, 0.25})};
    for (matvar_t* v : all) {
      Mat_VarWrite(file, v, MAT_COMPRESSION_NONE);
      Mat_VarFree(v);
    }
    Mat_Close(file);
    const Measurement m = ReadMeasurement(path);
    EXPECT_TRUE(m.record.channels.empty());
    EXPECT_THAT(m.frequency.frequency, ElementsAre(10, 20, 40));
    ASSERT_EQ(m.frequency.responses.size(), 1u);
    EXPECT_EQ(m.frequency.responses[0].name, "S_ax");
    EXPECT_EQ(m.frequency.responses[0].values[2], std::complex<double>(-2, 3));
    ASSERT_EQ(m.frequency.coherence.size(), 1u);
    EXPECT_EQ(m.frequency.coherence[0].name, "S_ax");
    EXPECT_THAT(m.frequency.coherence[0].values, ElementsAre(1, 0.5, 0.25));
  }
}

TEST(Mat, UnequalLengthsAndDamageAreErrors) {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.mat");
  const auto error = [&] { return ErrorText<InputError>([&] { ReadMat(path); }); };
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
  matvar_t *y = Doubles("y", {1, 2}), *z = Doubles("z", {4, 5, 6});
  Mat_VarWrite(file, y, MAT_COMPRESSION_NONE);
  Mat_VarWrite(file, z, MAT_COMPRESSION_NONE);
  Mat_VarFree(y);
  Mat_VarFree(z);
  Mat_Close(file);
  EXPECT_EQ(error(), path + ": channel z has 3 rows, y has 2");
  WriteBytes(path, "no mat");
  EXPECT_EQ(error(), path + ": not a MAT file");
  WriteBytes(path, std::string(5000, 'x'));
  EXPECT_EQ(error(), path + ": not a MAT file of version 5 or 7.3");
  for (const auto compression : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
    WriteForeign(path, MAT_FT_MAT5, compression);
    const std::string whole = ReadBytes(path);
    for (std::size_t size = 1; size < whole.size(); size += 7) {
      WriteBytes(path, whole.substr(0, size));
      EXPECT_THAT(error(), ::testing::StartsWith(path + ": ")) << size;
    }
  }
}

TEST(Mat, AFullDiskLeavesNothing) {
  const TemporaryFolder folder;
  Record large = MatExample();
  for (Channel& c : large.channels) c.samples.resize(20000, 0.5);
  rlimit limit = {};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small = {20000, limit.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string text = ErrorText<InputError>([&] { WriteMat(large, folder.File("a.mat")); });
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(text, ::testing::StartsWith("cannot write " + folder.File("a.mat") + ": "));
  EXPECT_TRUE(folder.Names().empty());
}

}  // namespace
}  // namespace ambrig
