#include "bake_part.hpp"

#include "error.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

namespace ao::tools {
namespace {

using json = nlohmann::ordered_json;

constexpr std::string_view magic = "ao bake part 1\r\n";
static_assert(magic.size() == 16);
static_assert(sizeof(bake_sum) == 32 && std::is_trivially_copyable_v<bake_sum>);
static_assert(std::endian::native == std::endian::little, "parts are written as they are in memory");

// Fowler-Noll-Vo's scheme over words of 64 bits, mixed once more at the end (the finaliser of MurmurHash3).
class hash {
public:
    void word(std::uint64_t w)
    {
        state = (state ^ w) * 0x100000001b3U;
        state ^= state >> 29U;
    }
    void bytes(const void* from, std::size_t size)
    {
        const char* p = static_cast<const char*>(from);
        for (; size >= 8; size -= 8, p += 8) {
            std::uint64_t w = 0;
            std::memcpy(&w, p, 8);
            word(w);
        }
        std::uint64_t rest = 0;
        std::memcpy(&rest, p, size);
        word(rest + (std::uint64_t{ size } << 56U));
    }
    template <class T>
    void array(const std::vector<T>& values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        word(values.size());
        if (!values.empty())
            bytes(values.data(), values.size() * sizeof(T));
    }
    void number(double x) { word(std::bit_cast<std::uint64_t>(x)); }
    [[nodiscard]] std::uint64_t value() const
    {
        std::uint64_t h = state;
        h = (h ^ (h >> 33U)) * 0xff51afd7ed558ccdU;
        h = (h ^ (h >> 33U)) * 0xc4ceb9fe1a85ec53U;
        return h ^ (h >> 33U);
    }

private:
    std::uint64_t state = 0xcbf29ce484222325U;
};

json numbers_of(const bake_area& a)
{
    return { a.first_vertex, a.last_vertex, a.first_line, a.last_line };
}

bake_area area_from(const json& j)
{
    const bake_area a{ j.at(0).get<std::size_t>(), j.at(1).get<std::size_t>(), j.at(2).get<std::size_t>(),
                       j.at(3).get<std::size_t>() };
    if (a.first_vertex > a.last_vertex || a.first_line > a.last_line)
        throw error("the part is damaged");
    return a;
}

bool within(const bake_area& a, const bake_area& b)
{
    return a.first_vertex >= b.first_vertex && a.last_vertex <= b.last_vertex && a.first_line >= b.first_line &&
           a.last_line <= b.last_line;
}

// What is left of `from` without `hole`, in up to four areas. Lines first: they are even wherever both are.
void subtract(const bake_area& from, const bake_area& hole, std::vector<bake_area>& to)
{
    if (!overlap(from, hole)) {
        to.push_back(from);
        return;
    }
    bake_area middle = from;
    if (hole.first_line > from.first_line) {
        to.push_back({ from.first_vertex, from.last_vertex, from.first_line, hole.first_line });
        middle.first_line = hole.first_line;
    }
    if (hole.last_line < from.last_line) {
        to.push_back({ from.first_vertex, from.last_vertex, hole.last_line, from.last_line });
        middle.last_line = hole.last_line;
    }
    if (hole.first_vertex > from.first_vertex)
        to.push_back({ from.first_vertex, hole.first_vertex, middle.first_line, middle.last_line });
    if (hole.last_vertex < from.last_vertex)
        to.push_back({ hole.last_vertex, from.last_vertex, middle.first_line, middle.last_line });
}

std::string shard_name(const bake_part& p)
{
    return "shard " + std::to_string(p.shard) + "/" + std::to_string(p.shards);
}

} // namespace

bake_area area_of(const bake_sums& s)
{
    return { s.first_vertex, s.last_vertex, s.first_line, s.last_line };
}

bake_area area_of(const ao::bake_job& job)
{
    return { 0, job.vertices(), 0, job.lines.size() };
}

bool overlap(const bake_area& a, const bake_area& b)
{
    return std::max(a.first_vertex, b.first_vertex) < std::min(a.last_vertex, b.last_vertex) &&
           std::max(a.first_line, b.first_line) < std::min(a.last_line, b.last_line);
}

bake_area shard_of(const ao::bake_job& job, std::size_t i, std::size_t n)
{
    bake_area a = area_of(job);
    const auto cut = [&](std::size_t count, std::size_t at) { return (count / n) * at + std::min(count % n, at); };
    if (job.line_pairs() >= 16 * n) {
        a.first_line = 2 * cut(job.line_pairs(), i - 1);
        a.last_line = std::min(2 * cut(job.line_pairs(), i), job.lines.size());
    }
    else {
        a.first_vertex = cut(job.vertices(), i - 1);
        a.last_vertex = cut(job.vertices(), i);
    }
    return a;
}

std::uint64_t bake_part::size_done() const
{
    std::uint64_t sum = 0;
    for (const bake_sums& s : done)
        sum += area_of(s).size();
    return sum;
}

std::vector<bake_area> bake_part::missing() const
{
    std::vector<bake_area> left;
    if (wanted.size() > 0)
        left.push_back(wanted);
    for (const bake_sums& s : done) {
        std::vector<bake_area> next;
        for (const bake_area& a : left)
            subtract(a, area_of(s), next);
        left = std::move(next);
    }
    return left;
}

void bake_part::add(bake_sums sums)
{
    if (area_of(sums).size() == 0)
        return;
    if (done.empty() || !merge_bake_sums(done.back(), sums))
        done.push_back(std::move(sums));
    // Two areas that were finished one after another may be one now.
    while (done.size() > 1 && merge_bake_sums(done[done.size() - 2], done.back()))
        done.pop_back();
}

std::uint64_t key_of(const ao::bake_job& job)
{
    hash h;
    const bake_mesh& m = job.mesh;
    h.array(m.points);
    h.array(m.triangles);
    h.array(m.objects);
    h.array(m.vertices);
    h.array(m.flags);
    h.array(m.vertex_objects);
    h.word(job.lines.size());
    for (const bake_line& line : job.lines)
        h.bytes(&line, sizeof line);
    const bake_settings& s = job.settings;
    for (const int choice : { static_cast<int>(s.coefficient), static_cast<int>(s.falloff), static_cast<int>(s.sides),
                              static_cast<int>(s.occluders), static_cast<int>(s.bent_normals), static_cast<int>(s.ground),
                              static_cast<int>(job.domain), static_cast<int>(job.turned()) })
        h.word(static_cast<std::uint64_t>(choice));
    h.number(static_cast<double>(job.reach));
    if (s.rotate_per_vertex)
        h.word(s.seed);
    for (int i = 0; i < 4; ++i)
        h.number(static_cast<double>(job.ground[i]));
    // The only routes whose sums are their own.
    h.word(s.route == bake_route::embree || s.route == bake_route::cube ? static_cast<std::uint64_t>(s.route) : 0);
    return h.value();
}

std::string bytes_of(const bake_part& part)
{
    json header = { { "choice", part.choice },
                    { "model", part.model },
                    { "key", part.key },
                    { "vertices", part.vertices },
                    { "lines", part.lines },
                    { "shard", { part.shard, part.shards } },
                    { "wanted", numbers_of(part.wanted) },
                    { "device", part.device },
                    { "seconds", part.seconds },
                    { "done", json::array() } };
    for (const bake_sums& s : part.done)
        header["done"].push_back(
            { { "area", numbers_of(area_of(s)) }, { "route", static_cast<int>(s.route) }, { "reason", s.reason } });
    const std::string text = header.dump(-1, ' ', false, json::error_handler_t::replace);
    std::string out(magic);
    const std::uint64_t size = text.size();
    out.append(reinterpret_cast<const char*>(&size), sizeof size);
    out += text;
    for (const bake_sums& s : part.done)
        out.append(reinterpret_cast<const char*>(s.sums.data()), s.sums.size() * sizeof(bake_sum));
    hash h;
    h.bytes(out.data(), out.size());
    const std::uint64_t sum = h.value();
    return out.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

bake_part part_from(std::string_view bytes)
{
    if (bytes.substr(0, magic.size()) != magic.substr(0, std::min(bytes.size(), magic.size())) || bytes.empty())
        throw error("not a part of a bake");
    if (bytes.size() < magic.size() + 16)
        throw error("cut short");
    std::uint64_t sum = 0;
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    bytes.remove_suffix(sizeof sum);
    hash h;
    h.bytes(bytes.data(), bytes.size());
    if (h.value() != sum)
        throw error("cut short or damaged");
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + magic.size(), sizeof size);
    bytes.remove_prefix(magic.size() + sizeof size);
    bake_part part;
    try {
        const json header = json::parse(bytes.substr(0, static_cast<std::size_t>(size)));
        bytes.remove_prefix(static_cast<std::size_t>(size));
        part.choice = header.at("choice").get<std::string>();
        part.model = header.at("model").get<std::string>();
        part.key = header.at("key").get<std::uint64_t>();
        part.vertices = header.at("vertices").get<std::size_t>();
        part.lines = header.at("lines").get<std::size_t>();
        part.shard = header.at("shard").at(0).get<std::size_t>();
        part.shards = header.at("shard").at(1).get<std::size_t>();
        part.wanted = area_from(header.at("wanted"));
        part.device = header.at("device").get<std::string>();
        part.seconds = header.at("seconds").get<double>();
        for (const json& each : header.at("done")) {
            const bake_area a = area_from(each.at("area"));
            const std::size_t count = a.last_vertex - a.first_vertex;
            if (!within(a, part.wanted) || count > bytes.size() / sizeof(bake_sum))
                throw error("the part is damaged");
            bake_sums s{ a.first_vertex,
                         a.last_vertex,
                         a.first_line,
                         a.last_line,
                         std::vector<bake_sum>(count),
                         static_cast<bake_route>(each.at("route").get<int>()),
                         each.at("reason").get<std::string>() };
            std::memcpy(s.sums.data(), bytes.data(), count * sizeof(bake_sum));
            bytes.remove_prefix(count * sizeof(bake_sum));
            part.done.push_back(std::move(s));
        }
    } catch (const json::exception&) {
        throw error("the part is damaged");
    }
    if (part.wanted.last_vertex > part.vertices || part.wanted.last_line > part.lines)
        throw error("the part is damaged");
    return part;
}

bake_sums together(const std::vector<bake_part>& parts)
{
    bake_sums all;
    all.last_vertex = parts.front().vertices;
    all.last_line = parts.front().lines;
    all.sums.resize(all.last_vertex);
    for (const bake_part& part : parts)
        for (const bake_sums& s : part.done) {
            for (std::size_t i = 0; i < s.sums.size(); ++i)
                all.sums[s.first_vertex + i] += s.sums[i];
            all.route = s.route;
            all.reason = s.reason;
        }
    return all;
}

void check_together(const std::vector<bake_part>& parts, const std::vector<std::string>& files)
{
    const bake_part& first = parts.front();
    std::uint64_t size = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const bake_part& p = parts[i];
        if (p.key != first.key || p.vertices != first.vertices || p.lines != first.lines || p.choice != first.choice)
            throw error(files[i] + ": of another bake than " + files[0]);
        if (!p.complete())
            throw error(files[i] + ": " + shard_name(p) + " is not finished");
        for (std::size_t k = 0; k < i; ++k)
            if (p.shards == parts[k].shards ? p.shard == parts[k].shard : overlap(p.wanted, parts[k].wanted))
                throw error(files[i] + ": " + shard_name(p) + (p.shards == parts[k].shards ? " is in " : " overlaps ") +
                            files[k] + (p.shards == parts[k].shards ? ", too" : ""));
        size += p.wanted.size();
    }
    if (size == std::uint64_t{ first.vertices } * first.lines)
        return;
    for (std::size_t i = 1; i <= first.shards; ++i)
        if (std::none_of(parts.begin(), parts.end(),
                         [&](const bake_part& p) { return p.shards == first.shards && p.shard == i; }))
            throw error("shard " + std::to_string(i) + "/" + std::to_string(first.shards) + " is missing");
    throw error("shards are missing");
}

} // namespace ao::tools
