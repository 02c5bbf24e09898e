// G. Turk, "The PLY polygon file format", 1994: ASCII and binary of both byte orders.
#include "bake_model.hpp"
#include "error.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <system_error>

namespace ao::tools {
namespace {

enum class number_type { i8, u8, i16, u16, i32, u32, f32, f64 };

struct property {
    std::string name;
    number_type type{};
    std::optional<number_type> count; // of a list
};

struct element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<property> properties;
};

number_type type_of(const std::string& word)
{
    static const std::pair<const char*, number_type> names[] = {
        { "char", number_type::i8 },     { "int8", number_type::i8 },     { "uchar", number_type::u8 },
        { "uint8", number_type::u8 },    { "short", number_type::i16 },   { "int16", number_type::i16 },
        { "ushort", number_type::u16 },  { "uint16", number_type::u16 },  { "int", number_type::i32 },
        { "int32", number_type::i32 },   { "uint", number_type::u32 },    { "uint32", number_type::u32 },
        { "float", number_type::f32 },   { "float32", number_type::f32 }, { "double", number_type::f64 },
        { "float64", number_type::f64 },
    };
    for (const auto& [name, type] : names)
        if (word == name)
            return type;
    throw error("the PLY header has an unknown type '" + one_line(word) + "'");
}

std::size_t size_of(number_type type)
{
    constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 4, 8 };
    return sizes[static_cast<std::size_t>(type)];
}

// Values one after another.
class ply_body {
public:
    ply_body(std::string_view b, bool is_text, bool is_swapped) : bytes(b), text(is_text), swapped(is_swapped) {}

    double next(number_type type)
    {
        if (text)
            return next_word();
        switch (type) {
        case number_type::i8:
            return static_cast<double>(binary<std::int8_t>());
        case number_type::u8:
            return static_cast<double>(binary<std::uint8_t>());
        case number_type::i16:
            return static_cast<double>(binary<std::int16_t>());
        case number_type::u16:
            return static_cast<double>(binary<std::uint16_t>());
        case number_type::i32:
            return static_cast<double>(binary<std::int32_t>());
        case number_type::u32:
            return static_cast<double>(binary<std::uint32_t>());
        case number_type::f32:
            return static_cast<double>(binary<float>());
        case number_type::f64:
            break;
        }
        return binary<double>();
    }
    [[nodiscard]] std::size_t left() const { return bytes.size(); }

private:
    template <class T>
    T binary()
    {
        if (bytes.size() < sizeof(T))
            throw error("the PLY file is cut short");
        char raw[sizeof(T)];
        std::memcpy(raw, bytes.data(), sizeof(T));
        if (swapped)
            std::reverse(raw, raw + sizeof(T));
        bytes.remove_prefix(sizeof(T));
        T value;
        std::memcpy(&value, raw, sizeof(T));
        return value;
    }
    double next_word()
    {
        const std::size_t start = bytes.find_first_not_of(" \t\r\n");
        if (start == std::string_view::npos)
            throw error("the PLY file is cut short");
        bytes.remove_prefix(start);
        const std::string_view word = bytes.substr(0, bytes.find_first_of(" \t\r\n"));
        const std::size_t sign = word.front() == '+' ? 1 : 0;
        double value = 0;
        const auto [end, code] = std::from_chars(word.data() + sign, word.data() + word.size(), value);
        if (code == std::errc::result_out_of_range)
            value = std::numeric_limits<double>::infinity(); // reported as not finite
        else if (code != std::errc() || end != word.data() + word.size())
            throw error("'" + one_line(std::string(word.substr(0, 40))) + "' in the PLY file is not a number");
        bytes.remove_prefix(word.size());
        return value;
    }

    std::string_view bytes;
    bool text;
    bool swapped;
};

class ply_reader {
public:
    bake_model read(std::string_view bytes)
    {
        const std::size_t body_at = read_header(bytes);
        ply_body body(bytes.substr(body_at), format == "ascii",
                      (format == "binary_big_endian") != (std::endian::native == std::endian::big));
        for (const element& e : elements) {
            check_size(e, body);
            if (e.name == "vertex")
                read_vertices(e, body);
            else if (e.name == "face")
                read_faces(e, body);
            else
                for (std::uint64_t i = 0; i < e.count; ++i)
                    for (const property& p : e.properties)
                        skip(p, body);
        }
        check_indices();
        model.object_names.emplace_back("model");
        return std::move(model);
    }

private:
    // Of the body.
    std::size_t read_header(std::string_view bytes)
    {
        std::size_t at = 0;
        for (std::size_t number = 0;; ++number) {
            const std::size_t end = bytes.find('\n', at);
            if (end == std::string_view::npos || number > 10000)
                throw error("truncated, the PLY header has no end");
            std::vector<std::string> words(1);
            for (const char c : bytes.substr(at, end - at)) {
                if (c != ' ' && c != '\t' && c != '\r')
                    words.back() += c;
                else if (!words.back().empty())
                    words.emplace_back();
            }
            if (words.back().empty() && words.size() > 1)
                words.pop_back();
            at = end + 1;
            if (number == 0 && words[0] != "ply")
                throw error("not a PLY file");
            if (words[0] == "end_header")
                break;
            header_line(words);
        }
        if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
            throw error("the PLY header names no known format");
        return at;
    }

    void header_line(const std::vector<std::string>& words)
    {
        if (words[0] == "format" && words.size() >= 2) {
            format = words[1];
        }
        else if (words[0] == "element" && words.size() == 3) {
            element e{ words[1], 0, {} };
            const auto [end, code] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), e.count);
            if (code != std::errc() || end != words[2].data() + words[2].size() || e.count > 0xfffffffeU)
                throw error("the PLY header has a count of '" + one_line(words[2]) + "'");
            elements.push_back(e);
        }
        else if (words[0] == "property" && !elements.empty() && words.size() == 3) {
            elements.back().properties.push_back({ words[2], type_of(words[1]), {} });
        }
        else if (words[0] == "property" && !elements.empty() && words.size() == 5 && words[1] == "list") {
            elements.back().properties.push_back({ words[4], type_of(words[3]), type_of(words[2]) });
        }
        else if (words[0] == "property" || words[0] == "element") {
            throw error("the PLY header has a broken line '" + one_line(words[0]) + " ...'");
        }
    }

    // Before anything is reserved for what the header promises.
    void check_size(const element& e, const ply_body& body) const
    {
        std::size_t least = 0;
        for (const property& p : e.properties)
            least += format == "ascii" ? 2 : size_of(p.count.value_or(p.type));
        // The last number needs no blank behind it.
        if (e.count > 0 && least == 0)
            throw error("the PLY header has elements '" + one_line(e.name) + "' without properties");
        if (e.count > (body.left() + 1) / std::max<std::size_t>(least, 1))
            throw error("the PLY file is cut short");
    }

    static std::size_t list_size(const property& p, ply_body& body)
    {
        const double count = body.next(*p.count);
        if (!(count >= 0.0 && count <= static_cast<double>(body.left()) + 1.0) || count != std::floor(count))
            throw error("the PLY file has a list of a wrong length");
        return static_cast<std::size_t>(count);
    }

    static void skip(const property& p, ply_body& body)
    {
        const std::size_t count = p.count ? list_size(p, body) : 1;
        for (std::size_t i = 0; i < count; ++i)
            (void)body.next(p.type);
    }

    void read_vertices(const element& e, ply_body& body)
    {
        static constexpr const char* names[] = { "x", "y", "z", "nx", "ny", "nz" };
        std::vector<int> places;
        for (const property& p : e.properties) {
            const auto* const found = std::find(std::begin(names), std::end(names), p.name);
            places.push_back(p.count || found == std::end(names) ? -1 : static_cast<int>(found - names));
        }
        const auto has = [&](int place) { return std::count(places.begin(), places.end(), place) > 0; };
        if (!has(0) || !has(1) || !has(2))
            throw error("the PLY file's vertices have no x, y and z");
        const bool normals = has(3) && has(4) && has(5);
        for (std::uint64_t i = 0; i < e.count; ++i) {
            double values[6] = {};
            for (std::size_t k = 0; k < e.properties.size(); ++k) {
                if (places[k] < 0)
                    skip(e.properties[k], body);
                else
                    values[places[k]] = body.next(e.properties[k].type);
            }
            model.positions.emplace_back(values[0], values[1], values[2]);
            if (normals) {
                const glm::dvec3 n(values[3], values[4], values[5]);
                const double length = glm::length(n);
                model.normals.push_back(std::isfinite(length) && length > 0.0 ? glm::vec3(n / length) : glm::vec3(0.0f));
            }
        }
    }

    void read_faces(const element& e, ply_body& body)
    {
        std::vector<std::uint32_t> corners;
        for (std::uint64_t i = 0; i < e.count; ++i)
            for (const property& p : e.properties) {
                if (!p.count || (p.name != "vertex_indices" && p.name != "vertex_index")) {
                    skip(p, body);
                    continue;
                }
                corners.resize(list_size(p, body));
                for (std::uint32_t& c : corners) {
                    const double index = body.next(p.type);
                    if (!(index >= 0.0 && index < 4294967295.0) || index != std::floor(index))
                        throw error("face " + std::to_string(i) + " has an index that is no vertex");
                    c = static_cast<std::uint32_t>(index);
                }
                model.add_polygon(corners, 0);
            }
    }

    void check_indices() const
    {
        for (std::size_t i = 0; i < model.polygons(); ++i)
            for (const std::uint32_t c : model.polygon(i))
                if (c >= model.positions.size())
                    throw error("a face has vertex " + std::to_string(c) + " of " + std::to_string(model.positions.size()));
    }

    std::string format;
    std::vector<element> elements;
    bake_model model;
};

} // namespace

bake_model read_ply(std::string_view bytes)
{
    return ply_reader().read(bytes);
}

} // namespace ao::tools
