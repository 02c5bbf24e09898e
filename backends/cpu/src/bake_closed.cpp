#include "bake_closed.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace ao::cpu::detail {

namespace {

constexpr double least_distance = bake_outside_steps / 8388608;

// Sets of triangles that hang together by edges.
class sets {
public:
    explicit sets(std::size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0U); }

    std::uint32_t of(std::uint32_t i)
    {
        while (above_[i] != i) {
            above_[i] = above_[above_[i]];
            i = above_[i];
        }
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { above_[of(a)] = of(b); }

private:
    std::vector<std::uint32_t> above_;
};

// 1 for triangles of sets in which every edge is walked as often one way as the other.
std::vector<std::int32_t> closed_triangles(const bake_group& group)
{
    struct edge {
        std::uint64_t ends; // the lesser point first
        std::uint32_t triangle;
        std::int32_t way;
    };
    const std::size_t count = group.task.occluders.triangle_count;
    std::vector<edge> edges;
    edges.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto from = static_cast<std::uint64_t>(group.corners[k][i]);
            const auto to = static_cast<std::uint64_t>(group.corners[(k + 1) % 3][i]);
            edges.push_back(
                { std::min(from, to) << 32U | std::max(from, to), static_cast<std::uint32_t>(i), from < to ? 1 : -1 });
        }
    }
    std::sort(edges.begin(), edges.end(), [](const edge& a, const edge& b) { return a.ends < b.ends; });
    sets joined(count);
    std::vector<std::uint32_t> borders; // a triangle of each edge that does not close
    for (std::size_t i = 0; i < edges.size();) {
        std::int32_t sum = 0;
        const std::size_t first = i;
        for (; i < edges.size() && edges[i].ends == edges[first].ends; ++i) {
            sum += edges[i].way;
            joined.join(edges[first].triangle, edges[i].triangle);
        }
        if (sum != 0) {
            borders.push_back(edges[first].triangle);
        }
    }
    std::vector<std::int32_t> of_set(count, 1);
    for (const std::uint32_t triangle : borders) {
        of_set[joined.of(triangle)] = 0;
    }
    std::vector<std::int32_t> closed(count);
    for (std::size_t i = 0; i < count; ++i) {
        closed[i] = of_set[joined.of(static_cast<std::uint32_t>(i))];
    }
    return closed;
}

// Ericson, "Real-Time Collision Detection" (2005), 5.1.5: from the origin.
double squared_distance(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    const auto to_segment = [](const glm::dvec3& p, const glm::dvec3& q) {
        const glm::dvec3 along = q - p;
        const double length = glm::dot(along, along);
        const double t = length > 0 ? std::clamp(-glm::dot(p, along) / length, 0.0, 1.0) : 0.0;
        const glm::dvec3 foot = p + along * t;
        return glm::dot(foot, foot);
    };
    const double edges = std::min({ to_segment(a, b), to_segment(b, c), to_segment(c, a) });
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double squared = glm::dot(normal, normal);
    const bool over = glm::dot(normal, glm::cross(a, b)) >= 0 && glm::dot(normal, glm::cross(b, c)) >= 0 &&
                      glm::dot(normal, glm::cross(c, a)) >= 0;
    if (!over || !(squared > 0)) {
        return edges;
    }
    const double height = glm::dot(normal, a);
    return std::min(edges, height * height / squared);
}

// Starts in cells across a line, to which closed triangles are shown one after the other.
class outside_test {
public:
    explicit outside_test(const bake_group& group)
    {
        const std::size_t count = group.task.receivers.count;
        for (std::size_t i = 0; i < count; ++i) {
            starts_.push_back(seen({ group.starts.x[i], group.starts.y[i], group.starts.z[i] }));
        }
        across_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(count) / 2)));
        first_.assign(static_cast<std::size_t>(across_) * static_cast<std::size_t>(across_) + 1, 0);
        for (const glm::dvec3& s : starts_) {
            ++first_[cell(place(s.x), place(s.y)) + 1];
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        sorted_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            sorted_[next[cell(place(starts_[i].x), place(starts_[i].y))]++] = static_cast<std::uint32_t>(i);
        }
        winding_.assign(count, 0);
        unsure_.assign(count, 0);
    }

    void show(const std::array<glm::dvec3, 3>& corners)
    {
        const glm::dvec3 a = seen(corners[0]);
        const glm::dvec3 b = seen(corners[1]);
        const glm::dvec3 c = seen(corners[2]);
        const glm::dvec3 low = glm::min(a, glm::min(b, c)) - least_distance;
        const glm::dvec3 high = glm::max(a, glm::max(b, c)) + least_distance;
        const int right = place(high.x);
        const int bottom = place(high.y);
        for (int y = place(low.y); y <= bottom; ++y) {
            for (int x = place(low.x); x <= right; ++x) {
                for (std::uint32_t k = first_[cell(x, y)]; k < first_[cell(x, y) + 1]; ++k) {
                    const std::uint32_t i = sorted_[k];
                    const glm::dvec3& s = starts_[i];
                    if (s.x >= low.x && s.x <= high.x && s.y >= low.y && s.y <= high.y) {
                        meet(i, a - s, b - s, c - s, s.z >= low.z && s.z <= high.z);
                    }
                }
            }
        }
    }

    // Starts that are not known to be outside.
    std::vector<std::uint32_t> apart() const
    {
        std::vector<std::uint32_t> found;
        for (std::size_t i = 0; i < starts_.size(); ++i) {
            if (winding_[i] != 0 || unsure_[i] != 0) {
                found.push_back(static_cast<std::uint32_t>(i));
            }
        }
        return found;
    }

private:
    // A line that edges of models hardly ever lie along.
    static glm::dvec3 seen(const glm::dvec3& p)
    {
        const glm::dvec3 d = glm::normalize(glm::dvec3(0.35730, 0.64217, 0.67841));
        const glm::dvec3 u = glm::normalize(glm::cross(d, glm::dvec3(0.81, 0.13, -0.57)));
        return { glm::dot(p, u), glm::dot(p, glm::cross(d, u)), glm::dot(p, d) };
    }
    int place(double x) const
    {
        return std::clamp(static_cast<int>((std::clamp(x, -1.0, 1.0) + 1) * 0.5 * across_), 0, across_ - 1);
    }
    std::size_t cell(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(x);
    }

    // Corners as a start sees them.
    void meet(std::uint32_t i, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, bool near)
    {
        constexpr double tiny = 1e-12; // of products below 4: hundreds of times their rounding
        if (near && squared_distance(a, b, c) < least_distance * least_distance) {
            unsure_[i] = 1;
            return;
        }
        const auto edge = [](const glm::dvec3& p, const glm::dvec3& q) { return p.x * q.y - p.y * q.x; };
        const glm::dvec3 shares(edge(b, c), edge(c, a), edge(a, b));
        const double least = std::min({ shares.x, shares.y, shares.z });
        const double greatest = std::max({ shares.x, shares.y, shares.z });
        if (least < -tiny && greatest > tiny) {
            return;
        }
        const double area = shares.x + shares.y + shares.z;
        const double moment = shares.x * a.z + shares.y * b.z + shares.z * c.z;
        const bool inside = least > tiny || greatest < -tiny;
        if (!inside || std::abs(moment) < 1e-9 * std::abs(area) + 1e-14) {
            unsure_[i] = 1;
        }
        else if ((moment > 0) == (area > 0)) {
            winding_[i] += area > 0 ? 1 : -1;
        }
    }

    std::vector<glm::dvec3> starts_;
    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> sorted_;
    std::vector<std::int32_t> winding_;
    std::vector<std::uint8_t> unsure_;
    int across_ = 1;
};

} // namespace

void find_closed_surfaces(bake_group& group)
{
    std::vector<std::int32_t> closed = closed_triangles(group);
    if (std::count(closed.begin(), closed.end(), 1) == 0) {
        return;
    }
    outside_test test(group);
    for (std::size_t i = 0; i < closed.size(); ++i) {
        if (closed[i] != 0) {
            const auto corner = [&](std::size_t k) {
                const bake_vectors& p = group.task.occluders.places[k];
                return glm::dvec3(p.x[i], p.y[i], p.z[i]);
            };
            test.show({ corner(0), corner(1), corner(2) });
        }
    }
    std::vector<std::uint32_t> apart = test.apart();
    if (apart.size() > group.vertices.size() / 8) {
        return;
    }
    group.apart = std::move(apart);
    group.closed = std::move(closed);
    group.closed.insert(group.closed.end(), bake_padding, 0);
    group.task.occluders.closed = group.closed.data();
}

} // namespace ao::cpu::detail
