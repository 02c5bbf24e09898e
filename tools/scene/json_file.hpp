#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ao::tools {

class json_file;

// A value of a JSON file, by reference: the file outlives it. Every accessor throws `error` with file, line, column and path
// where the value is of another type.
class json_value {
public:
    [[nodiscard]] bool is_string() const;
    [[nodiscard]] bool is_object() const;
    [[nodiscard]] bool is_array() const;

    [[nodiscard]] const std::string& string() const;
    [[nodiscard]] bool boolean() const;
    // As float: finite and not beyond its range, from `low` on.
    [[nodiscard]] float number(double low = -1.0e30, double high = 1.0e30) const;
    // Of an array of `count` numbers.
    [[nodiscard]] std::vector<float> numbers(std::size_t count, double low = -1.0e30) const;

    // Of an array or an object, in the file's order.
    [[nodiscard]] std::vector<json_value> children() const;
    // Of a member of an object; the index of an array's element as a word.
    [[nodiscard]] std::string key() const;
    // Of an object; throws for members of other names.
    void allow(std::initializer_list<std::string_view> names) const;
    [[nodiscard]] std::optional<json_value> find(std::string_view name) const;
    // Throws where there is none.
    [[nodiscard]] json_value at(std::string_view name) const;

    // "/blends/terrace/second"; long ones are cut in the middle.
    [[nodiscard]] std::string path() const;
    // Throws `error`: "blend.json:7:21: /blends/terrace/second: " and the reason. Lines and columns count from 1, columns in
    // bytes.
    [[noreturn]] void fail(const std::string& reason) const;

    // Of the value in its file, to remember it by.
    [[nodiscard]] std::size_t index() const { return index_; }

private:
    friend class json_file;
    json_value(const json_file& file, std::size_t index) : file_(&file), index_(index) {}

    const json_file* file_;
    std::size_t index_;
};

// A JSON text (RFC 8259) with the place of every value in it. Nested as deep as it may be: nothing here recurses.
class json_file {
public:
    // `name` is what errors begin with. Throws `error`: not JSON, or an object that has two members of one name.
    json_file(std::string name, std::string text);
    json_file(const json_file&) = delete;
    json_file& operator=(const json_file&) = delete;

    // Throws `error`: no such file, not a regular file, more than 16 MiB, or as the constructor does.
    [[nodiscard]] static std::string read(const std::string& path);

    [[nodiscard]] json_value root() const { return value(0); }
    [[nodiscard]] json_value value(std::size_t index) const { return { *this, index }; }

private:
    friend class json_value;
    friend struct json_recorder;

    enum class kind : unsigned char { null, boolean, number, string, array, object };
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    struct entry {
        kind type{};
        std::size_t offset = 0; // of its first byte in the text
        std::size_t parent = none;
        std::size_t next = none; // sibling
        std::size_t first = none;
        std::size_t position = 0; // among its siblings
        double number = 0;
        std::string key;
        std::string text;
    };

    // "name:line:column".
    [[nodiscard]] std::string place(std::size_t offset) const;
    static const char* name_of(kind k);

    std::string name_;
    std::string text_;
    std::vector<entry> entries_;
};

// A word of the user's in a message: no control characters, at most 60 bytes.
[[nodiscard]] std::string in_quotes(const std::string& word);

} // namespace ao::tools
