#include "fuzz/xml_mutation.hpp"

#include <tinyxml2.h>

#include "fuzz/hostile_values.hpp"

namespace jourdain::tests {

namespace {

std::vector<tinyxml2::XMLElement*> elements(tinyxml2::XMLDocument& document) {
  std::vector<tinyxml2::XMLElement*> found;
  if (document.RootElement()) found.push_back(document.RootElement());
  for (std::size_t i = 0; i < found.size(); ++i)
    for (auto* e = found[i]->FirstChildElement(); e; e = e->NextSiblingElement()) found.push_back(e);
  return found;
}

std::vector<const tinyxml2::XMLAttribute*> attributes(const tinyxml2::XMLElement& element) {
  std::vector<const tinyxml2::XMLAttribute*> found;
  for (auto* a = element.FirstAttribute(); a; a = a->Next()) found.push_back(a);
  return found;
}

std::string hostile_value(const std::string& before, tinyxml2::XMLDocument& document, const XmlWords& words,
                          Random& random) {
  const double choice = random.unit();
  if (choice < 0.25) return one_of(words.values, random);
  if (choice < 0.6) return any_number(random);
  if (choice < 0.7) return hostile_name(random);
  if (choice < 0.85) return before + (random.chance(0.5) ? "0" : " ");
  const auto all = elements(document);
  const char* name = one_of(all, random)->Attribute("name");
  return name ? name : before;
}

void change_attribute(tinyxml2::XMLDocument& document, tinyxml2::XMLElement& element, const XmlWords& words,
                      Random& random) {
  if (!words.attributes.empty() && random.chance(0.3))
    return element.SetAttribute(one_of(words.attributes, random).c_str(),
                                hostile_value("1", document, words, random).c_str());
  const auto list = attributes(element);
  if (list.empty()) return element.SetAttribute("name", hostile_name(random).c_str());
  const std::string name = one_of(list, random)->Name(), value = element.Attribute(name.c_str());
  if (random.chance(0.15)) element.DeleteAttribute(name.c_str());
  if (random.chance(0.1)) return element.SetAttribute((name + "s").c_str(), value.c_str());
  element.SetAttribute(name.c_str(), hostile_value(value, document, words, random).c_str());
}

/// Under another parent, which is no descendant of its own.
void move(tinyxml2::XMLDocument& document, tinyxml2::XMLElement& element, Random& random) {
  const auto all = elements(document);
  tinyxml2::XMLElement* parent = one_of(all, random);
  for (tinyxml2::XMLNode* node = parent; node; node = node->Parent())
    if (node == &element) return;
  parent->InsertEndChild(&element);
}

void change_element(tinyxml2::XMLDocument& document, tinyxml2::XMLElement& element, const XmlWords& words,
                    Random& random) {
  const std::size_t choice = random.below(6);
  if (choice == 0 && element.Parent()->ToElement()) return element.Parent()->DeleteChild(&element);
  if (choice == 1 && element.Parent()->ToElement())
    return (void)element.Parent()->InsertEndChild(element.DeepClone(&document));
  if (choice == 2) return element.SetName(one_of(words.elements, random).c_str());
  if (choice == 3) return move(document, element, random);
  if (choice == 4) return (void)element.InsertNewChildElement(one_of(words.elements, random).c_str());
  if (random.chance(0.5)) return (void)element.InsertNewText(hostile_name(random).c_str());
  element.InsertNewComment("--");
}

}  // namespace

std::string mutated_xml(const std::string& text, const XmlWords& words, int times, Random& random) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.c_str()) != tinyxml2::XML_SUCCESS) return text;
  for (int i = 0; i < times; ++i) {
    const auto all = elements(document);
    if (all.empty()) break;
    tinyxml2::XMLElement& element = *one_of(all, random);
    random.chance(0.6) ? change_attribute(document, element, words, random)
                       : change_element(document, element, words, random);
  }
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace jourdain::tests
