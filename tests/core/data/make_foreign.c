/* Makes foreign.h5, a record as other programs write them. h5cc make_foreign.c && ./a.out */
#include <hdf5.h>
#include <string.h>

static void Text(hid_t object, const char* name, const char* text, int padded_to) {
  hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, padded_to > 0 ? (size_t)padded_to : H5T_VARIABLE);
  if (padded_to > 0) H5Tset_strpad(type, H5T_STR_SPACEPAD);
  hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  char padded[64];
  memset(padded, ' ', sizeof padded);
  memcpy(padded, text, strlen(text));
  if (padded_to > 0)
    H5Awrite(attribute, type, padded);
  else
    H5Awrite(attribute, type, &text);
  H5Aclose(attribute);
}

static hid_t Data(hid_t group, const char* name, hid_t file_type, int rank, const hsize_t* dims,
                  hid_t type, const void* data) {
  hid_t space = H5Screate_simple(rank, dims, NULL);
  hid_t set = H5Dcreate2(group, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
  return set;
}

int main(void) {
  const hsize_t four[2] = {4, 1}, square[2] = {2, 2};
  const double x[4] = {0.5, -1.25, 0.0 / 0.0, 3};
  const int i[4] = {-7, 0, 1, 2000000000};
  const int rate = 25000;
  hid_t file = H5Fcreate("foreign.h5", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  hid_t group = H5Gcreate2(file, "A", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  hid_t inner = H5Gcreate2(group, "r", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  Text(Data(group, "x", H5T_IEEE_F64BE, 1, four, H5T_NATIVE_DOUBLE, x), "unit", "\xc2\xb5m", 0);
  Text(Data(group, "i1", H5T_STD_I32LE, 2, four, H5T_NATIVE_INT, i), "unit", "mA", 8);
  Data(inner, "y", H5T_STD_I64BE, 1, four, H5T_NATIVE_INT, i);
  Text(Data(file, "bus", H5T_IEEE_F32LE, 1, four, H5T_NATIVE_DOUBLE, x), "unit", "V", 1);
  Data(file, "matrix", H5T_IEEE_F64LE, 2, square, H5T_NATIVE_DOUBLE, x);
  H5Lcreate_hard(file, "A", group, "ring", H5P_DEFAULT, H5P_DEFAULT);
  H5Lcreate_soft("/bus", file, "alias", H5P_DEFAULT, H5P_DEFAULT);
  hsize_t one = 1;
  hid_t space = H5Screate_simple(1, &one, NULL);
  hid_t attribute = H5Acreate2(file, "rate", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, H5T_NATIVE_INT, &rate);
  Text(file, "logger", "DAQ 7", 0);
  H5Fclose(file);
  return 0;
}
