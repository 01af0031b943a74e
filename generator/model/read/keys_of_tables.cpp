#include "model/read/keys_of_tables.hpp"

namespace jourdain::model {

KeySection table_section() {
  return {"table",
          "[[table]]",
          "A function of one number or two that is given by points; expressions of this file call it, "
          "valve_train(camshaft.rate).",
          {{"name", "name", "", kRequired, "an identifier that means nothing else in expressions"},
           {"x", "list of constants", "x_unit", kRequired, "two or more, rising"},
           {"y", "list of constants", "y_unit", "none", "makes it a function of two numbers"},
           {"values", "list of numbers or lists", "unit", kRequired,
            "one for each x; with y a list for each x, one number for each y. Cubics have constants; how "
            "many there may be says [Tables](expressions.md#tables)"},
           {"file", "text", "", "none",
            "instead of x, y and values: lines of x, value; or a line of a word and the points of y, then "
            "lines of x "
            "and its values"},
           {"x_unit", "text", "", "none", "of bare numbers; strict once given, as that of a parameter"},
           {"y_unit", "text", "", "none", ""},
           {"unit", "text", "", "none", "of the values"},
           {"interpolation", "\"linear\", \"monotone\", \"spline\"", "", "\"linear\"",
            "monotone: cubics that rise and fall where the values do; spline: cubics without jumps of the "
            "curvature"},
           {"beyond", "\"hold\", \"extend\", \"repeat\"", "", "\"hold\"",
            "the end's value, a line with its slope, or the same again: of one argument"},
           {"description", "text", "", "empty", ""}},
          R"([[table]]
name = "valve_train"
x = [-1500, 0, 1500, 3000]
x_unit = "rpm"
values = [0.8, 0, -0.8, -1.1]
unit = "N m"
interpolation = "monotone"
beyond = "extend"
)"};
}

KeySection function_section() {
  return {"function",
          "[[function]]",
          "A function that is given by an expression of its arguments; expressions of this file call it, "
          "grip(slip, load).",
          {{"name", "name", "", kRequired, "an identifier that means nothing else in expressions"},
           {"arguments", "list of names", "", kRequired, "one or more, which are no parameters"},
           {"argument_units", "texts", "", "none",
            "an SI unit for each argument; strict once given, as that of a parameter"},
           {"value", "expression", "unit", kRequired,
            "of the arguments, parameters, tables and functions before it; what moves is an argument"},
           {"unit", "text", "", "none", "an SI unit"},
           {"external", "true, false", "", "false",
            "emitted code calls a function of yours in its place: "
            "[Functions of your own](expressions.md#functions-of-your-own)"},
           {"range", "2 constants", "unit", "[1, 3]",
            "of an external one: its values where compiled code is compared, which are not those of 'value'"},
           {"description", "text", "", "empty", ""}},
          R"([[function]]
name = "grip"
arguments = ["slip", "load"]
argument_units = ["1", "N"]
unit = "N"
value = "0.9*sin(1.4*atan(12*slip))*load"
)"};
}

}  // namespace jourdain::model
