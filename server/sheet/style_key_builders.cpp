#include "sheet/style_key_builders.h"

namespace voxsheet::sheet {

KeySpec choice(std::string name, std::vector<std::string> choices, std::string initial, std::string group,
               std::string doc) {
    KeySpec key;
    key.name = std::move(name);
    key.type = KeyType::Choice;
    key.choices = std::move(choices);
    key.defaultValue = std::move(initial);
    key.group = std::move(group);
    key.widget = "select";
    key.doc = std::move(doc);
    return key;
}

KeySpec number(std::string name, std::string unit, double min, double max, StyleValue initial,
               std::string group, std::string doc, std::string widget) {
    KeySpec key;
    key.name = std::move(name);
    key.type = KeyType::Number;
    key.unit = std::move(unit);
    key.min = min;
    key.max = max;
    key.defaultValue = std::move(initial);
    key.group = std::move(group);
    key.widget = std::move(widget);
    key.doc = std::move(doc);
    return key;
}

KeySpec typed(std::string name, KeyType type, StyleValue initial, std::string group, std::string widget,
              std::string doc) {
    KeySpec key;
    key.name = std::move(name);
    key.type = type;
    key.defaultValue = std::move(initial);
    key.group = std::move(group);
    key.widget = std::move(widget);
    key.doc = std::move(doc);
    return key;
}

KeySpec numberRows(std::string name, RowsShape shape, StyleValue initial, std::string group,
                   std::string doc) {
    KeySpec key = typed(std::move(name), KeyType::NumberRows, std::move(initial), std::move(group), "rows",
                        std::move(doc));
    key.columnNames = std::move(shape.columnNames);
    key.minRows = shape.minRows;
    key.maxRows = shape.maxRows;
    key.min = shape.min;
    key.max = shape.max;
    return key;
}

KeySpec withNone(KeySpec key) {
    key.takesNone = true;
    return key;
}

KeySpec withAuto(KeySpec key) {
    key.takesAuto = true;
    return key;
}

KeySpec when(KeySpec key, std::string other, std::vector<std::string> values) {
    key.appliesWhen = {std::move(other), std::move(values)};
    return key;
}

} // namespace voxsheet::sheet
