// Text of a fixed capacity put together in constant expressions, for the reasons of errors and explanations.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>

namespace ao::detail {

// Longer texts are cut.
template <std::size_t Capacity>
class fixed_text {
public:
    template <class... Part>
    constexpr explicit fixed_text(const Part&... parts)
    {
        (append(parts), ...);
    }
    constexpr void append(std::string_view part)
    {
        for (const char c : part) {
            if (size_ < Capacity) {
                text_[size_++] = c;
            }
        }
    }
    template <std::integral Integer>
    constexpr void append(Integer value)
    {
        std::array<char, 24> digits{};
        std::size_t first = digits.size();
        const bool negative = value < 0;
        do {
            const int digit = static_cast<int>(value % 10);
            digits[--first] = static_cast<char>('0' + (digit < 0 ? -digit : digit));
            value = static_cast<Integer>(value / 10);
        } while (value != 0);
        if (negative) {
            digits[--first] = '-';
        }
        append(std::string_view(digits.data() + first, digits.size() - first));
    }
    constexpr operator std::string_view() const { return { text_.data(), size_ }; }

private:
    std::array<char, Capacity> text_{};
    std::size_t size_ = 0;
};

// One line that says what is wrong.
using reason = fixed_text<255>;

} // namespace ao::detail
