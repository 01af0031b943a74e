#include "readback/types.hpp"

#include <fmt/format.h>

#include "readback/known_text.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

constexpr long kLongestArray = 1000000;
constexpr long kMostLanes = 4;

Type of(Type::Kind kind) {
  Type type;
  type.kind = kind;
  return type;
}

}  // namespace

const Field* StructType::find(Symbol name) const {
  for (const Field& field : fields)
    if (field.name == name) return &field;
  return nullptr;
}

TypeTable::TypeTable(const Unit& unit, NumberType number, IntegerOf integer_of)
    : unit_(unit),
      number_type_(number),
      integer_of_(std::move(integer_of)),
      void_(of(Type::Kind::kVoid)),
      boolean_(of(Type::Kind::kBool)),
      integer_(of(Type::Kind::kInteger)),
      native_(of(Type::Kind::kNative)),
      float_(of(Type::Kind::kNative)),
      number_(of(Type::Kind::kNumber)),
      sum_(of(Type::Kind::kNumber)),
      function_(of(Type::Kind::kFunction)) {}

const Type* TypeTable::array(const Type* element, long extent) {
  if (extent < 1 || extent > kLongestArray) throw Refusal(fmt::format("an array of {} entries", extent));
  const Type*& known = arrays_[{element, extent}];
  if (!known) {
    Type& made = types_.emplace_back(of(Type::Kind::kArray));
    made.element = element;
    made.extent = extent;
    made.cells = static_cast<std::size_t>(extent) * element->cells;
    known = &made;
  }
  return known;
}

const Type* TypeTable::lanes(long count) {
  if (count < 2 || count > kMostLanes) throw Refusal(fmt::format("{} lanes", count));
  const Type*& known = lanes_[count];
  if (!known) {
    Type& made = types_.emplace_back(of(Type::Kind::kLanes));
    made.element = &number_;
    made.extent = count;
    made.cells = static_cast<std::size_t>(count);
    known = &made;
  }
  return known;
}

const Type* TypeTable::built_in(const std::string& name) const {
  if (name == "int") return &integer_;
  if (name == "bool") return &boolean_;
  if (name == "void") return &void_;
  if (name == "double") return number_type_ == NumberType::kDouble ? &number_ : &native_;
  if (name == "float") return number_type_ == NumberType::kFloat ? &number_ : &float_;
  return nullptr;
}

const Struct* TypeTable::find_struct(const std::vector<Symbol>& path, const Lookup& lookup) const {
  const std::string inner = lookup.scope ? *lookup.scope : "";
  const auto find = [&](const std::string& scope) -> const Struct* {
    for (const Struct* known : unit_.structs)
      if (known->name == path.back() && known->scope == scope) return known;
    return nullptr;
  };
  if (path.size() == 2) {
    const std::string& space = unit_.symbols.text(path[0]);
    return find(space == unit_.name_of_namespace ? "" : space);
  }
  const Struct* found = find(inner);
  return found || inner.empty() ? found : find("");
}

Bindings TypeTable::bindings_of(const Struct& syntax, const TypeName& name, const Lookup& lookup) {
  Bindings bindings;
  if (name.arguments.size() > syntax.parameters_of_template.size())
    throw Refusal(fmt::format("too many template arguments in {}", text_of(unit_, name)));
  for (std::size_t i = 0; i < syntax.parameters_of_template.size(); ++i) {
    const TemplateParameter& parameter = syntax.parameters_of_template[i];
    Binding& binding = bindings.emplace_back();
    binding.name = parameter.name;
    if (i >= name.arguments.size())
      throw Refusal(fmt::format("too few template arguments in {}", text_of(unit_, name)));
    const TemplateArgument& argument = name.arguments[i];
    if (parameter.is_type == (argument.value != nullptr))
      throw Refusal(fmt::format("a template argument of the wrong kind in {}", text_of(unit_, name)));
    if (argument.value)
      binding.integer = integer_of_(*argument.value, lookup);
    else
      binding.type = resolve(argument.type, lookup);
  }
  return bindings;
}

const Type* TypeTable::resolve(const TypeName& name, const Lookup& lookup) {
  if (name.path.empty()) throw Refusal("a type without a name");
  const Symbol last = name.path.back();
  if (name.path.size() == 1) {
    if (lookup.bindings)
      for (const Binding& binding : *lookup.bindings)
        if (binding.name == last && binding.type) return binding.type;
    if (const Type* known = built_in(unit_.symbols.text(last))) return known;
    if (lookup.inside)
      if (const auto it = lookup.inside->syntax->aliases.find(last);
          it != lookup.inside->syntax->aliases.end())
        return resolve(it->second, {&lookup.inside->bindings, nullptr, nullptr});
  }
  if (unit_.numbers.count(last) && name.arguments.size() == 1 &&
      resolve(name.arguments[0].type, lookup) == &number_)
    return &sum_;
  if (unit_.numbers.count(last) && unit_.symbols.text(last) == kLanesType && name.arguments.size() == 2 &&
      name.arguments[0].value && resolve(name.arguments[1].type, lookup) == &number_)
    return lanes(integer_of_(*name.arguments[0].value, lookup));
  const Struct* syntax = find_struct(name.path, lookup);
  if (!syntax) throw Refusal(fmt::format("the type {} is not known here", text_of(unit_, name)));
  return instance(*syntax, bindings_of(*syntax, name, lookup));
}

const Type* TypeTable::resolve(const TypeName& name, const Declarator& declarator, const Lookup& lookup) {
  const Type* type = resolve(name, lookup);
  for (std::size_t i = declarator.bounds.size(); i-- > 0;) {
    if (!declarator.bounds[i]) throw Refusal("an array without its length");
    type = array(type, integer_of_(*declarator.bounds[i], lookup));
  }
  return type;
}

const Type* TypeTable::instance(const std::string& name, const Bindings& arguments) {
  for (const Struct* known : unit_.structs)
    if (unit_.symbols.text(known->name) == name && known->scope.empty()) {
      if (known->parameters_of_template.size() != arguments.size())
        throw Refusal(
            fmt::format("{} has {} template parameters", name, known->parameters_of_template.size()));
      Bindings bindings = arguments;
      for (std::size_t i = 0; i < bindings.size(); ++i)
        bindings[i].name = known->parameters_of_template[i].name;
      return instance(*known, bindings);
    }
  throw Refusal(fmt::format("there is no struct {}", name));
}

const Type* TypeTable::instance(const Struct& syntax, const Bindings& bindings) {
  std::vector<std::pair<const Type*, long>> key;
  for (const Binding& binding : bindings) key.emplace_back(binding.type, binding.integer);
  const Type*& known = instances_[{&syntax, key}];
  if (!known) {
    StructType& made = struct_types_.emplace_back();
    made.syntax = &syntax;
    made.bindings = bindings;
    Type& type = types_.emplace_back(of(Type::Kind::kStruct));
    type.structure = &made;
    lay_out(made, syntax, type);
    known = &type;
  }
  return known;
}

void TypeTable::lay_out(StructType& made, const Struct& syntax, Type& type) {
  type.cells = 0;
  const std::string scope = syntax.scope;
  for (const Member& member : syntax.members) {
    if (member.is_static) continue;
    if (member.declarator.indirection != 0) throw Refusal("a pointer or reference in a struct");
    if (made.find(member.declarator.name))
      throw Refusal(fmt::format("two members '{}'", unit_.symbols.text(member.declarator.name)));
    const Lookup lookup = {&made.bindings, &made, &scope};
    const Type* field = member.anonymous ? instance(*member.anonymous, made.bindings)
                                         : resolve(member.type, member.declarator, lookup);
    made.fields.push_back({member.declarator.name, field, type.cells, member.declarator.initial});
    type.cells += field->cells;
  }
}

std::string TypeTable::text(const Type* type) const {
  switch (type->kind) {
    case Type::Kind::kVoid:
      return "void";
    case Type::Kind::kBool:
      return "bool";
    case Type::Kind::kInteger:
      return "int";
    case Type::Kind::kNative:
      return "double";
    case Type::Kind::kNumber:
      return "Real";
    case Type::Kind::kStruct:
      return unit_.symbols.text(type->structure->syntax->name);
    case Type::Kind::kArray:
      return fmt::format("{}[{}]", text(type->element), type->extent);
    case Type::Kind::kLanes:
      return fmt::format("{}<{}, Real>", kLanesType, type->extent);
    case Type::Kind::kFunction:
      return "function";
  }
  return "";
}

}  // namespace jourdain::readback
