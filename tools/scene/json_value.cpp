#include "error.hpp"
#include "json_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ao::tools {
namespace {

std::string shortest(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%g", x);
    return text;
}

} // namespace

bool json_value::is_string() const
{
    return file_->entries_[index_].type == json_file::kind::string;
}

bool json_value::is_object() const
{
    return file_->entries_[index_].type == json_file::kind::object;
}

bool json_value::is_array() const
{
    return file_->entries_[index_].type == json_file::kind::array;
}

const std::string& json_value::string() const
{
    const json_file::entry& e = file_->entries_[index_];
    if (e.type != json_file::kind::string)
        fail(std::string("must be a string, is ") + json_file::name_of(e.type));
    return e.text;
}

bool json_value::boolean() const
{
    const json_file::entry& e = file_->entries_[index_];
    if (e.type != json_file::kind::boolean)
        fail(std::string("must be true or false, is ") + json_file::name_of(e.type));
    return e.number != 0.0;
}

float json_value::number(double low, double high) const
{
    const json_file::entry& e = file_->entries_[index_];
    if (e.type != json_file::kind::number)
        fail(std::string("must be a number, is ") + json_file::name_of(e.type));
    if (!(e.number >= low && e.number <= high))
        fail("must be " + shortest(low) + " to " + shortest(high) + ", is " + shortest(e.number));
    return static_cast<float>(e.number);
}

std::vector<float> json_value::numbers(std::size_t count, double low) const
{
    const json_file::entry& e = file_->entries_[index_];
    const std::string wanted = "must be an array of " + std::to_string(count) + " numbers";
    if (e.type != json_file::kind::array)
        fail(wanted + ", is " + json_file::name_of(e.type));
    std::vector<float> values;
    for (const json_value& v : children())
        values.push_back(v.number(low));
    if (values.size() != count)
        fail(wanted + ", has " + std::to_string(values.size()));
    return values;
}

std::vector<json_value> json_value::children() const
{
    std::vector<json_value> all;
    for (std::size_t i = file_->entries_[index_].first; i != json_file::none; i = file_->entries_[i].next)
        all.push_back(file_->value(i));
    return all;
}

std::string json_value::key() const
{
    const json_file::entry& e = file_->entries_[index_];
    const bool element = e.parent != json_file::none && file_->entries_[e.parent].type == json_file::kind::array;
    return element ? std::to_string(e.position) : e.key;
}

void json_value::allow(std::initializer_list<std::string_view> names) const
{
    if (!is_object())
        fail(std::string("must be an object, is ") + json_file::name_of(file_->entries_[index_].type));
    for (const json_value& member : children()) {
        const std::string name = member.key();
        if (std::find(names.begin(), names.end(), name) != names.end())
            continue;
        std::string known;
        for (const std::string_view each : names)
            known += (known.empty() ? "" : ", ") + std::string(each);
        member.fail("unknown member; known are " + known);
    }
}

std::optional<json_value> json_value::find(std::string_view name) const
{
    if (!is_object())
        fail(std::string("must be an object, is ") + json_file::name_of(file_->entries_[index_].type));
    for (std::size_t i = file_->entries_[index_].first; i != json_file::none; i = file_->entries_[i].next)
        if (file_->entries_[i].key == name)
            return file_->value(i);
    return std::nullopt;
}

json_value json_value::at(std::string_view name) const
{
    const std::optional<json_value> found = find(name);
    if (!found)
        fail("has no member '" + std::string(name) + "'");
    return *found;
}

std::string json_value::path() const
{
    std::vector<std::string> names; // from the inside
    for (std::size_t i = index_; file_->entries_[i].parent != json_file::none; i = file_->entries_[i].parent) {
        std::string name = one_line(file_->value(i).key());
        if (name.size() > 60)
            name = name.substr(0, 57) + "...";
        names.push_back(std::move(name));
    }
    constexpr std::size_t most = 8;
    std::string text;
    for (std::size_t i = names.size(); i > 0; --i) {
        if (names.size() > most && i == names.size() - most / 2) {
            text += "/...";
            i = most / 2;
        }
        text += "/" + names[i - 1];
    }
    return text.empty() ? "/" : text;
}

void json_value::fail(const std::string& reason) const
{
    throw error(file_->place(file_->entries_[index_].offset) + ": " + path() + ": " + reason);
}

} // namespace ao::tools
