#pragma once
#include <optional>
#include <string>
#include <utility>

namespace ao::host {
// One line without a full stop, fit to stand behind "ao: ".
struct failure {
    std::string text;
};

// A value, or the reason why there is none.
template <class T>
class [[nodiscard]] result {
public:
    result(T value) : value_(std::move(value)) {}
    result(failure reason) : reason_(std::move(reason)) {}

    explicit operator bool() const { return value_.has_value(); }
    T& operator*() { return *value_; }
    const T& operator*() const { return *value_; }
    T* operator->() { return &*value_; }
    const T* operator->() const { return &*value_; }
    const std::string& reason() const { return reason_.text; }

private:
    std::optional<T> value_;
    failure reason_;
};

struct done {};
}
