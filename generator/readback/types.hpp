// Types of the text that is executed, with instances of its struct templates.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "readback/syntax.hpp"

namespace jourdain::readback {

struct StructType;

/// Types are equal where their addresses are.
struct Type {
  enum class Kind : std::uint8_t {
    kVoid,
    kBool,
    kInteger,
    kNative,
    kNumber,
    kStruct,
    kArray,
    kLanes,
    kFunction
  };
  Kind kind = Kind::kVoid;
  const Type* element = nullptr;  ///< kArray, kLanes
  long extent = 0;                ///< kArray; kLanes: numbers that are computed with at once
  const StructType* structure = nullptr;
  std::size_t cells = 1;  ///< of memory
};

/// What a template's parameter stands for: a type or an integer.
struct Binding {
  Symbol name = 0;
  const Type* type = nullptr;
  long integer = 0;
};
using Bindings = std::vector<Binding>;

struct Field {
  Symbol name = 0;
  const Type* type = nullptr;
  std::size_t offset = 0;
  const Expression* initial = nullptr;
};

/// An instance of a struct template.
struct StructType {
  const Struct* syntax = nullptr;
  Bindings bindings;
  std::vector<Field> fields;

  const Field* find(Symbol name) const;
};

/// Which type stands for `double` and `float` of the text. The numbers that are computed with have one type;
/// it is neither, or one of them.
enum class NumberType : std::uint8_t { kOwn, kDouble, kFloat };

/// Where a type's name is looked up.
struct Lookup {
  const Bindings* bindings = nullptr;
  const StructType* inside = nullptr;  ///< whose aliases are known
  const std::string* scope = nullptr;  ///< namespace within the outer one, or empty
};

class TypeTable {
 public:
  /// Integer value of a bound or template argument, from whoever evaluates expressions.
  using IntegerOf = std::function<long(const Expression&, const Lookup&)>;

  TypeTable(const Unit& unit, NumberType number, IntegerOf integer_of);

  const Type* number() const { return &number_; }
  /// A sum of several numbers: in exact arithmetic one.
  bool is_sum(const Type* type) const { return type == &sum_; }
  const Type* integer() const { return &integer_; }
  const Type* native() const { return &native_; }
  const Type* boolean() const { return &boolean_; }
  const Type* nothing() const { return &void_; }
  const Type* function() const { return &function_; }
  const Type* array(const Type* element, long extent);
  const Type* lanes(long count);
  /// Throws Refusal where the name is unknown.
  const Type* resolve(const TypeName& name, const Lookup& lookup);
  /// With the declarator's bounds.
  const Type* resolve(const TypeName& name, const Declarator& declarator, const Lookup& lookup);
  /// The struct template of that name, seen from `scope`; null where there is none.
  const Struct* find_struct(const std::vector<Symbol>& path, const Lookup& lookup) const;
  /// `Name<number>`.
  const Type* instance(const std::string& name, const Bindings& arguments);

  std::string text(const Type* type) const;

 private:
  const Type* instance(const Struct& syntax, const Bindings& bindings);
  void lay_out(StructType& made, const Struct& syntax, Type& type);
  const Type* built_in(const std::string& name) const;
  Bindings bindings_of(const Struct& syntax, const TypeName& name, const Lookup& lookup);

  const Unit& unit_;
  NumberType number_type_;
  IntegerOf integer_of_;
  Type void_, boolean_, integer_, native_, float_, number_, sum_, function_;
  std::deque<Type> types_;
  std::deque<StructType> struct_types_;
  std::map<std::pair<const Type*, long>, const Type*> arrays_;
  std::map<long, const Type*> lanes_;
  std::map<std::pair<const Struct*, std::vector<std::pair<const Type*, long>>>, const Type*> instances_;
  Symbol real_ = 0;
};

}  // namespace jourdain::readback
