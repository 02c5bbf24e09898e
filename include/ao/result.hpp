// Value or error, without exceptions and usable in constant expressions.
#pragma once

#include <cassert>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace ao {

enum class errc {
    invalid_settings,
    invalid_projection,
    unsupported_format,
    invalid_size,
    invalid_scene,
    plan_mismatch, // a plan other than the one a program was prepared for
    device,        // the API refused; error::native holds its code
    out_of_memory,
    shader,
};

// What went wrong, in one line of at most 255 bytes; longer texts are cut.
class error {
public:
    constexpr error(errc code, std::string_view reason, int native = 0) : code_(code), native_(native)
    {
        for (const char c : reason) {
            if (size_ + 1 == capacity) {
                break;
            }
            text_[size_++] = c;
        }
    }
    constexpr errc code() const { return code_; }
    constexpr int native() const { return native_; }
    constexpr std::string_view reason() const { return { text_, size_ }; }

private:
    static constexpr std::size_t capacity = 256;
    errc code_;
    int native_;
    std::size_t size_ = 0;
    char text_[capacity] = {};
};

struct success {};

template <class T>
class [[nodiscard]] result {
public:
    constexpr result(T value) : value_(std::move(value)) {}
    constexpr result(const ao::error& e) : error_(e) {}

    constexpr bool has_value() const { return value_.has_value(); }
    constexpr explicit operator bool() const { return has_value(); }
    // Precondition: has_value().
    constexpr T& value()
    {
        assert(has_value());
        return *value_;
    }
    constexpr const T& value() const
    {
        assert(has_value());
        return *value_;
    }
    constexpr T& operator*() { return value(); }
    constexpr const T& operator*() const { return value(); }
    constexpr T* operator->() { return &value(); }
    constexpr const T* operator->() const { return &value(); }
    // Precondition: !has_value().
    constexpr const ao::error& error() const
    {
        assert(!has_value());
        return *error_;
    }

private:
    // Not a variant: g++ 12 refuses std::get_if on temporaries in constant expressions.
    std::optional<T> value_;
    std::optional<ao::error> error_;
};

} // namespace ao
