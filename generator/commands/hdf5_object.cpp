#include "commands/hdf5_object.hpp"

#include <hdf5.h>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace jourdain::commands {

static_assert(std::is_same_v<hid_t, std::int64_t>);

namespace {

constexpr std::size_t kLongestText = 65536;  ///< bytes; headers hold no more

/// What the library says of errors is for its own developers; what it does at exit ends in a crash where a file could
/// not be written.
void prepare_library() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void check_written(bool is_written) {
  if (!is_written) throw Hdf5Failure("HDF5 fails");
}

Hdf5Object written(hid_t id) {
  check_written(id >= 0);
  return Hdf5Object(id);
}

/// Types of numbers, as they stand in a file and in memory.
template <class Value>
hid_t stored_type() {
  if constexpr (std::is_same_v<Value, double>) return H5T_IEEE_F64LE;
  if constexpr (std::is_same_v<Value, std::uint64_t>) return H5T_STD_U64LE;
  if constexpr (std::is_same_v<Value, std::uint8_t>) return H5T_STD_U8LE;
}
template <class Value>
hid_t native_type() {
  if constexpr (std::is_same_v<Value, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<Value, std::uint64_t>) return H5T_NATIVE_UINT64;
  if constexpr (std::is_same_v<Value, std::uint8_t>) return H5T_NATIVE_UINT8;
}

/// UTF-8 of so many bytes. Texts of any length would lie in a heap of the file, in which the library gets lost where it
/// is not sound.
Hdf5Object text_type(std::size_t size) {
  Hdf5Object type = written(H5Tcopy(H5T_C_S1));
  check_written(H5Tset_size(type.id(), size) >= 0 && H5Tset_cset(type.id(), H5T_CSET_UTF8) >= 0 &&
                H5Tset_strpad(type.id(), H5T_STR_NULLPAD) >= 0);
  return type;
}

/// Properties of what is made of that class.
Hdf5Object properties(hid_t of) {
  Hdf5Object list = written(H5Pcreate(of));
  constexpr unsigned kInOrder = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;
  check_written(H5Pset_obj_track_times(list.id(), false) >= 0);
  check_written(H5Pset_attr_creation_order(list.id(), kInOrder) >= 0);
  if (of != H5P_DATASET_CREATE) check_written(H5Pset_link_creation_order(list.id(), kInOrder) >= 0);
  return list;
}

Hdf5Object utf8_names(hid_t of) {
  Hdf5Object list = written(H5Pcreate(of));
  check_written(H5Pset_char_encoding(list.id(), H5T_CSET_UTF8) >= 0);
  return list;
}

/// A '/' would be a folder, "." the group itself: these are written as in addresses of the web.
std::string link_name(const std::string& name) {
  if (name == ".") return "%2E";
  std::string link;
  for (const char c : name) link += c == '/' ? "%2F" : c == '%' ? "%25" : std::string(1, c);
  return link;
}

std::string name_of_link(const std::string& link) {
  std::string name;
  for (std::size_t i = 0; i < link.size(); ++i) {
    const std::string code = link.substr(i, 3);
    const bool is_code = code == "%2F" || code == "%25" || code == "%2E";
    name += code == "%2F" ? '/' : code == "%2E" ? '.' : link[i];
    if (is_code) i += 2;
  }
  return name;
}

void write_attribute_of(const Hdf5Object& object, const std::string& name, hid_t stored, hid_t native,
                        const void* value) {
  const Hdf5Object space = written(H5Screate(H5S_SCALAR)), names = utf8_names(H5P_ATTRIBUTE_CREATE);
  const Hdf5Object attribute =
      written(H5Acreate2(object.id(), name.c_str(), stored, space.id(), names.id(), H5P_DEFAULT));
  check_written(H5Awrite(attribute.id(), native, value) >= 0);
}

/// An attribute that holds one value; false in a condition where there is none.
Hdf5Object open_attribute(const Hdf5Object& object, const std::string& name) {
  if (H5Aexists(object.id(), name.c_str()) <= 0) return Hdf5Object(-1);
  Hdf5Object attribute(H5Aopen(object.id(), name.c_str(), H5P_DEFAULT));
  if (!attribute) return attribute;
  const Hdf5Object space(H5Aget_space(attribute.id()));
  return space && H5Sget_simple_extent_type(space.id()) == H5S_SCALAR ? std::move(attribute) : Hdf5Object(-1);
}

template <class Value>
bool read_attribute_of(const Hdf5Object& object, const std::string& name, Value& value) {
  const Hdf5Object attribute = open_attribute(object, name);
  if (!attribute) return false;
  const Hdf5Object type(H5Aget_type(attribute.id()));
  return type && H5Tequal(type.id(), stored_type<Value>()) > 0 &&
         H5Aread(attribute.id(), native_type<Value>(), &value) >= 0;
}

herr_t add_link(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name_of_link(name));
  return 0;
}

herr_t add_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

}  // namespace

Hdf5Object::~Hdf5Object() {
  if (id_ >= 0) H5Idec_ref(id_);
}

Hdf5Object make_hdf5_file(const std::string& path, std::uint64_t head) {
  prepare_library();
  const Hdf5Object creation = properties(H5P_FILE_CREATE), access = written(H5Pcreate(H5P_FILE_ACCESS));
  check_written(H5Pset_userblock(creation.id(), head) >= 0);
  // The format of one version of the library, whichever runs.
  check_written(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18) >= 0);
  return written(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()));
}

void flush_hdf5_file(const Hdf5Object& file) { check_written(H5Fflush(file.id(), H5F_SCOPE_GLOBAL) >= 0); }

Hdf5Object make_group(const Hdf5Object& parent, const std::string& name) {
  const Hdf5Object creation = properties(H5P_GROUP_CREATE);
  return written(H5Gcreate2(parent.id(), name.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT));
}

template <class Value>
Hdf5Object make_column(const Hdf5Object& group, const std::string& name, const std::vector<Value>& values) {
  const hsize_t count = values.size();
  const Hdf5Object space = written(H5Screate_simple(1, &count, nullptr));
  const Hdf5Object links = utf8_names(H5P_LINK_CREATE), creation = properties(H5P_DATASET_CREATE);
  Hdf5Object column = written(H5Dcreate2(group.id(), link_name(name).c_str(), stored_type<Value>(),
                                         space.id(), links.id(), creation.id(), H5P_DEFAULT));
  check_written(H5Dwrite(column.id(), native_type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >=
                0);
  return column;
}

void write_attribute(const Hdf5Object& object, const std::string& name, const std::string& value) {
  const std::string text = value.empty() ? std::string(1, '\0') : value;
  const Hdf5Object type = text_type(text.size());
  write_attribute_of(object, name, type.id(), type.id(), text.data());
}
void write_attribute(const Hdf5Object& object, const std::string& name, std::uint64_t value) {
  write_attribute_of(object, name, stored_type<std::uint64_t>(), native_type<std::uint64_t>(), &value);
}
void write_attribute(const Hdf5Object& object, const std::string& name, double value) {
  write_attribute_of(object, name, stored_type<double>(), native_type<double>(), &value);
}

Hdf5Object open_hdf5_file(const std::string& path) {
  prepare_library();
  return Hdf5Object(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
}

Hdf5Object open_group(const Hdf5Object& parent, const std::string& name) {
  return Hdf5Object(H5Gopen2(parent.id(), name.c_str(), H5P_DEFAULT));
}

std::optional<std::vector<std::string>> names_in(const Hdf5Object& group) {
  std::vector<std::string> names;
  if (H5Literate(group.id(), H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, add_link, &names) < 0) return {};
  return names;
}

std::optional<std::vector<std::string>> attributes_of(const Hdf5Object& object) {
  std::vector<std::string> names;
  if (H5Aiterate2(object.id(), H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, add_attribute, &names) < 0)
    return {};
  return names;
}

Hdf5Object open_column(const Hdf5Object& group, const std::string& name) {
  return Hdf5Object(H5Dopen2(group.id(), link_name(name).c_str(), H5P_DEFAULT));
}

template <class Value>
bool read_column(const Hdf5Object& group, const std::string& name, std::uint64_t count,
                 std::vector<Value>& values) {
  const Hdf5Object column = open_column(group, name);
  if (!column) return false;
  const Hdf5Object type(H5Dget_type(column.id())), space(H5Dget_space(column.id()));
  hsize_t size = 0;
  if (!type || !space || H5Tequal(type.id(), stored_type<Value>()) <= 0 ||
      H5Sget_simple_extent_ndims(space.id()) != 1 ||
      H5Sget_simple_extent_dims(space.id(), &size, nullptr) != 1 || size != count)
    return false;
  values.resize(count);
  return H5Dread(column.id(), native_type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
}

bool read_attribute(const Hdf5Object& object, const std::string& name, std::string& value) {
  const Hdf5Object attribute = open_attribute(object, name);
  if (!attribute) return false;
  const Hdf5Object type(H5Aget_type(attribute.id()));
  const std::size_t size = type ? H5Tget_size(type.id()) : 0;
  if (size == 0 || size > kLongestText || H5Tequal(type.id(), text_type(size).id()) <= 0) return false;
  value.assign(size, '\0');
  if (H5Aread(attribute.id(), type.id(), value.data()) < 0) return false;
  value.erase(std::min(value.find('\0'), size));
  return true;
}
bool read_attribute(const Hdf5Object& object, const std::string& name, std::uint64_t& value) {
  return read_attribute_of(object, name, value);
}
bool read_attribute(const Hdf5Object& object, const std::string& name, double& value) {
  return read_attribute_of(object, name, value);
}

template Hdf5Object make_column(const Hdf5Object&, const std::string&, const std::vector<double>&);
template Hdf5Object make_column(const Hdf5Object&, const std::string&, const std::vector<std::uint64_t>&);
template Hdf5Object make_column(const Hdf5Object&, const std::string&, const std::vector<std::uint8_t>&);
template bool read_column(const Hdf5Object&, const std::string&, std::uint64_t, std::vector<double>&);
template bool read_column(const Hdf5Object&, const std::string&, std::uint64_t, std::vector<std::uint64_t>&);
template bool read_column(const Hdf5Object&, const std::string&, std::uint64_t, std::vector<std::uint8_t>&);

}  // namespace jourdain::commands
