// The little of HDF5 that results need: groups, columns, attributes; the same bytes each time they are written.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace jourdain::commands {

/// A file, group, column or what describes one; closed at the end of its life.
class Hdf5Object {
 public:
  explicit Hdf5Object(std::int64_t id) : id_(id) {}
  Hdf5Object(Hdf5Object&& other) noexcept : id_(other.id_) { other.id_ = -1; }
  Hdf5Object(const Hdf5Object&) = delete;
  Hdf5Object& operator=(const Hdf5Object&) = delete;
  Hdf5Object& operator=(Hdf5Object&&) = delete;
  ~Hdf5Object();

  std::int64_t id() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  std::int64_t id_;
};

/// HDF5 does not write what it should.
class Hdf5Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Writing throws Hdf5Failure. No times are kept; groups and attributes keep their order.

/// Overwrites; leaves the first `head` bytes of the file to others, a power of two from 512 on.
Hdf5Object make_hdf5_file(const std::string& path, std::uint64_t head);
/// All that was written is in the file.
void flush_hdf5_file(const Hdf5Object& file);
Hdf5Object make_group(const Hdf5Object& parent, const std::string& name);
/// Little-endian, one after the other, not compressed. A name may hold any characters. Here and below `Value` is
/// double, std::uint64_t or std::uint8_t.
template <class Value>
Hdf5Object make_column(const Hdf5Object& group, const std::string& name, const std::vector<Value>& values);
void write_attribute(const Hdf5Object& object, const std::string& name, const std::string& value);
void write_attribute(const Hdf5Object& object, const std::string& name, std::uint64_t value);
void write_attribute(const Hdf5Object& object, const std::string& name, double value);

// Reading gives nothing, or false, where there is no such thing of this type and size.

/// False in a condition where it cannot be opened.
Hdf5Object open_hdf5_file(const std::string& path);
Hdf5Object open_group(const Hdf5Object& parent, const std::string& name);
/// Names in a group, of attributes of an object, in the order in which they were made.
std::optional<std::vector<std::string>> names_in(const Hdf5Object& group);
std::optional<std::vector<std::string>> attributes_of(const Hdf5Object& object);
/// `count` values of column `name`.
template <class Value>
bool read_column(const Hdf5Object& group, const std::string& name, std::uint64_t count,
                 std::vector<Value>& values);
Hdf5Object open_column(const Hdf5Object& group, const std::string& name);
bool read_attribute(const Hdf5Object& object, const std::string& name, std::string& value);
bool read_attribute(const Hdf5Object& object, const std::string& name, std::uint64_t& value);
bool read_attribute(const Hdf5Object& object, const std::string& name, double& value);

}  // namespace jourdain::commands
