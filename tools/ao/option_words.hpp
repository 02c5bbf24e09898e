#pragma once

#include "scene/error.hpp"

#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace ao::tools {

[[nodiscard]] inline std::vector<std::string> split(const std::string& text, char at)
{
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

// What a word stands for; throws `error` with the option's name and all words.
template <class Value, std::size_t N>
Value choose(const char* option, const std::string& word, const std::array<std::pair<std::string_view, Value>, N>& choices)
{
    std::string all;
    for (const auto& [name, value] : choices) {
        if (name == word)
            return value;
        if (!all.empty())
            all += '|';
        all += name;
    }
    throw error(std::string(option) + ": '" + one_line(word) + "' is none of " + all);
}

// The whole text as a number of this type; throws `error`.
template <class Number>
Number number(const char* option, const std::string& text)
{
    Number value{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size())
        throw error(std::string(option) + ": '" + one_line(text) + "' is not a number in range");
    return value;
}

} // namespace ao::tools
