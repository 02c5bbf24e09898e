#include "json_file.hpp"

#include "error.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unordered_set>

namespace ao::tools {

std::string in_quotes(const std::string& word)
{
    constexpr std::size_t most = 60;
    std::string shown = one_line(word);
    if (shown.size() > most) {
        std::size_t end = most;
        while (end > 0 && (static_cast<unsigned char>(shown[end]) & 0xc0u) == 0x80u) // not inside a character
            --end;
        shown = shown.substr(0, end) + "...";
    }
    return "'" + shown + "'";
}

// Callbacks come in the text's order, each when its token has been read and found valid: so the place of each is found by
// following the text.
struct json_recorder {
    using json = nlohmann::json;

    json_file& file;
    std::size_t at = 0;                  // behind the last token
    std::vector<std::size_t> open;       // arrays and objects
    std::vector<std::size_t> last_child; // of each open one
    std::vector<std::unordered_set<std::string>> names;
    std::string next_key;

    // Of the token that begins next.
    std::size_t token()
    {
        constexpr std::string_view between = " \t\r\n,:";
        while (at < file.text_.size() && between.find(file.text_[at]) != std::string_view::npos)
            ++at;
        return at;
    }
    void skip_string()
    {
        for (++at; at < file.text_.size() && file.text_[at] != '"'; ++at)
            at += file.text_[at] == '\\' ? 1u : 0u;
        ++at;
    }
    json_file::entry& add(json_file::kind type)
    {
        const std::size_t index = file.entries_.size();
        json_file::entry& e = file.entries_.emplace_back();
        e.type = type;
        e.offset = token();
        if (!open.empty()) {
            e.parent = open.back();
            std::size_t& before = last_child.back();
            if (before == json_file::none) {
                file.entries_[e.parent].first = index;
            }
            else {
                file.entries_[before].next = index;
                e.position = file.entries_[before].position + 1;
            }
            before = index;
            e.key = std::move(next_key);
            next_key.clear();
        }
        return e;
    }
    bool word(json_file::kind type, std::size_t length)
    {
        add(type);
        at += length;
        return true;
    }
    bool begin(json_file::kind type)
    {
        add(type);
        ++at;
        open.push_back(file.entries_.size() - 1);
        last_child.push_back(json_file::none);
        names.emplace_back();
        return true;
    }
    bool end()
    {
        token();
        ++at;
        open.pop_back();
        last_child.pop_back();
        names.pop_back();
        return true;
    }
    bool number(double value)
    {
        add(json_file::kind::number).number = value;
        while (at < file.text_.size() && std::string_view("+-.0123456789eE").find(file.text_[at]) != std::string_view::npos)
            ++at;
        return true;
    }

    // What nlohmann::json::sax_parse calls.
    bool null() { return word(json_file::kind::null, 4); }
    bool boolean(bool value)
    {
        word(json_file::kind::boolean, value ? 4 : 5);
        file.entries_.back().number = value ? 1 : 0;
        return true;
    }
    bool number_integer(json::number_integer_t value) { return number(static_cast<double>(value)); }
    bool number_unsigned(json::number_unsigned_t value) { return number(static_cast<double>(value)); }
    bool number_float(json::number_float_t value, const json::string_t&) { return number(value); }
    bool string(json::string_t& value)
    {
        add(json_file::kind::string).text = std::move(value);
        skip_string();
        return true;
    }
    bool binary(json::binary_t&) { return false; } // no JSON text has one
    bool start_object(std::size_t) { return begin(json_file::kind::object); }
    bool start_array(std::size_t) { return begin(json_file::kind::array); }
    bool end_object() { return end(); }
    bool end_array() { return end(); }
    bool key(json::string_t& name)
    {
        const std::size_t place = token();
        if (!names.back().insert(name).second) {
            const std::string path = file.value(open.back()).path();
            throw error(file.place(place) + ": " + path + ": a second member " + in_quotes(name));
        }
        skip_string();
        next_key = std::move(name);
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& e)
    {
        // "[json.exception...] parse error at line 1, column 2: what" or "[...] what".
        std::string reason = e.what();
        const std::size_t placed = reason.find(", column ");
        const std::size_t prefix = placed == std::string::npos ? reason.find("] ") : reason.find(": ", placed);
        if (prefix != std::string::npos)
            reason = reason.substr(prefix + 2);
        reason = one_line(reason);
        constexpr std::size_t most = 200;
        if (reason.size() > most)
            reason = reason.substr(0, most / 2) + " ... " + reason.substr(reason.size() - most / 2);
        throw error(file.place(position > 0 ? position - 1 : 0) + ": " + reason);
    }
};

json_file::json_file(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text))
{
    json_recorder recorder{ *this, 0, {}, {}, {}, {} };
    if (text_.rfind("\xef\xbb\xbf", 0) == 0) // which the parser skips
        recorder.at = 3;
    if (!nlohmann::json::sax_parse(text_, &recorder))
        throw error(name_ + ": not JSON");
}

std::string json_file::read(const std::string& path)
{
    std::error_code failure;
    const std::filesystem::file_status status = std::filesystem::status(path, failure);
    if (!std::filesystem::exists(status))
        throw error(path + ": no such file");
    if (!std::filesystem::is_regular_file(status))
        throw error(path + ": not a regular file");
    if (std::filesystem::file_size(path, failure) > std::uintmax_t{ 1 } << 24)
        throw error(path + ": more than 16 MiB");
    std::ifstream in(path, std::ios::binary);
    std::string text{ std::istreambuf_iterator<char>(in), {} };
    if (!in || in.bad())
        throw error(path + ": cannot read");
    return text;
}

std::string json_file::place(std::size_t offset) const
{
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text_.size()));
    const auto line = std::count(text_.begin(), end, '\n') + 1;
    const auto start = std::find(std::make_reverse_iterator(end), text_.rend(), '\n').base();
    return name_ + ":" + std::to_string(line) + ":" + std::to_string(end - start + 1);
}

const char* json_file::name_of(kind k)
{
    constexpr const char* names[] = { "null", "true or false", "a number", "a string", "an array", "an object" };
    return names[static_cast<std::size_t>(k)];
}

} // namespace ao::tools
