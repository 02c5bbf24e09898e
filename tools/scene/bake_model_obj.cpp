#include "bake_model.hpp"
#include "error.hpp"

#include <glm/geometric.hpp>

#include <charconv>
#include <cmath>
#include <system_error>

namespace ao::tools {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

class obj_reader {
public:
    bake_model read(std::string_view text)
    {
        while (!text.empty()) {
            ++line;
            std::size_t end = text.find('\n');
            std::string_view one = text.substr(0, end);
            std::string joined;
            // A backslash at the end goes on in the next line.
            while (end != std::string_view::npos && ends_in_backslash(one)) {
                joined.assign(one.substr(0, one.find_last_of('\\'))).append(" ");
                text.remove_prefix(end + 1);
                ++line;
                end = text.find('\n');
                joined.append(text.substr(0, end));
                one = joined;
            }
            read_line(one);
            text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        }
        for (glm::dvec3& n : sums) {
            const double length = glm::length(n);
            model.normals.push_back(std::isfinite(length) && length > 1e-6 ? glm::vec3(n / length) : glm::vec3(0.0f));
        }
        return std::move(model);
    }

private:
    static bool ends_in_backslash(std::string_view text)
    {
        const std::size_t last = text.find_last_not_of(blanks);
        return last != std::string_view::npos && text[last] == '\\';
    }

    [[noreturn]] void fail(const std::string& what) const { throw error("line " + std::to_string(line) + ": " + what); }

    static std::string_view word(std::string_view& text)
    {
        const std::size_t start = text.find_first_not_of(blanks);
        if (start == std::string_view::npos)
            return text = {};
        const std::size_t end = std::min(text.find_first_of(blanks, start), text.size());
        const std::string_view found = text.substr(start, end - start);
        text.remove_prefix(end);
        return found;
    }

    glm::dvec3 three(std::string_view text) const
    {
        glm::dvec3 v(0.0);
        for (int i = 0; i < 3; ++i) {
            std::string_view w = word(text);
            w.remove_prefix(!w.empty() && w.front() == '+' ? 1 : 0);
            const auto [end, code] = std::from_chars(w.data(), w.data() + w.size(), v[i]);
            if (code == std::errc::result_out_of_range)
                v[i] = HUGE_VAL; // reported as not finite
            else if (code != std::errc() || end != w.data() + w.size())
                fail("three numbers are needed");
        }
        return v;
    }

    // 1 is the first, -1 the latest.
    std::size_t index(std::string_view text, std::size_t count, const char* what) const
    {
        long long i = 0;
        const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), i);
        if (code != std::errc() || end != text.data() + text.size())
            fail("'" + one_line(std::string(text)) + "' is not the number of a " + what);
        const auto all = static_cast<long long>(count);
        const long long found = i > 0 ? i - 1 : all + i;
        if (i == 0 || found < 0 || found >= all)
            fail(std::string("there is no ") + what + " " + std::to_string(i) + " of " + std::to_string(all));
        return static_cast<std::size_t>(found);
    }

    void begin_object(std::string_view name)
    {
        if (model.object_names.empty() || used) {
            model.object_names.emplace_back();
            used = false;
        }
        model.object_names.back() = one_line(std::string(name));
    }

    void face(std::string_view text)
    {
        corners.clear();
        for (std::string_view w = word(text); !w.empty(); w = word(text)) {
            const std::size_t slash = w.find('/');
            const std::size_t vertex = index(w.substr(0, slash), model.positions.size(), "vertex");
            corners.push_back(static_cast<std::uint32_t>(vertex));
            const std::size_t second = slash == std::string_view::npos ? slash : w.find('/', slash + 1);
            if (second != std::string_view::npos && second + 1 < w.size()) {
                sums.resize(model.positions.size(), glm::dvec3(0.0));
                const glm::dvec3& n = normals[index(w.substr(second + 1), normals.size(), "normal")];
                const double length = glm::length(n);
                if (std::isfinite(length) && length > 0.0)
                    sums[vertex] += n / length;
            }
        }
        if (model.object_names.empty())
            begin_object("model");
        used = used || corners.size() > 2;
        model.add_polygon(corners, static_cast<std::uint32_t>(model.object_names.size() - 1));
    }

    void read_line(std::string_view text)
    {
        const std::string_view kind = word(text);
        if (kind == "v")
            model.positions.push_back(three(text));
        else if (kind == "vn")
            normals.push_back(three(text));
        else if (kind == "f")
            face(text);
        else if (kind == "o" || kind == "g")
            begin_object(text);
        if (!sums.empty())
            sums.resize(model.positions.size(), glm::dvec3(0.0));
    }

    bake_model model;
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec3> sums; // of the corners' normals, by vertex
    std::vector<std::uint32_t> corners;
    std::size_t line = 0;
    bool used = false; // the latest object has faces
};

} // namespace

bake_model read_obj(std::string_view bytes)
{
    return obj_reader().read(bytes);
}

} // namespace ao::tools
