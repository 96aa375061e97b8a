#pragma once
/// What the reader and the writer of MATLAB files (mat.cc, mat_structs.cc,
/// mat_writer.cc) share: the library's objects owned, its numbers and texts. Included
/// by nobody else.
#include <matio.h>

#include <complex>
#include <memory>
#include <string>
#include <vector>

namespace ambrig::mat {

struct Closer {
  void operator()(mat_t* file) const { Mat_Close(file); }
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using File = std::unique_ptr<mat_t, Closer>;
using Variable = std::unique_ptr<matvar_t, Closer>;

/// Number of elements of a v5 file, -1 when one ends beyond the end of the file: the library takes
/// a truncated file for a shorter one.
int CountElements(const std::string& bytes);

/// More bytes than the arrays of this file can have: numbers may be stored in eighths
/// of their size, and compression takes at most 1032 bytes into one. Damaged sizes ask for more.
double MostBytes(const std::string& bytes);

/// Elements of an array: the product of its sizes.
double Elements(const matvar_t& v);

bool IsNumeric(const matvar_t& v);  // real numbers of any type
std::vector<double> Numbers(const matvar_t& v, std::size_t n);
bool IsComplex(const matvar_t& v);  // complex numbers of any type
std::vector<std::complex<double>> ComplexNumbers(const matvar_t& v, std::size_t n);
/// Text of a char row; empty for anything else, and for a text longer than 64 KiB: names and units
/// are short, and a damaged size asks for gigabytes.
std::string Text(const matvar_t& v);

/// Empty for what is no struct.
std::vector<std::string> FieldNames(const matvar_t& v);
/// The field of element `index` of a struct (array), nullptr when absent.
matvar_t* FieldOf(const matvar_t& v, const std::string& name, std::size_t index = 0);

}  // namespace ambrig::mat
