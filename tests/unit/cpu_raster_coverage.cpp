// Which pixels the CPU's triangles cover, against exact tests of every pixel centre with every triangle.
#include "unit/cpu_raster_support.hpp"

#include <random>

using namespace cpu_test;
using raster_test::mesh_data;
using raster_test::world;

namespace {

struct fixed_point {
    std::int64_t x;
    std::int64_t y;
};

// Side of the line from a to b on which a pixel centre lies; one on the line is moved to the right, and less so downwards, by an
// infinitely small step.
int side(fixed_point a, fixed_point b, fixed_point p)
{
    const std::int64_t across = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    const std::int64_t sign = across != 0 ? across : b.y != a.y ? a.y - b.y : b.x - a.x;
    return sign > 0 ? 1 : sign < 0 ? -1 : 0;
}

// Triangles in the plane of the picture with corners at multiples of 1/256 pixel, each an object of its own.
struct flat_scene {
    int width;
    int height;
    std::vector<std::array<fixed_point, 3>> triangles; // rows downwards, (0, 0) the corner of the first pixel

    std::vector<int> covering(int x, int y) const
    {
        const fixed_point centre{ 256 * std::int64_t{ x } + 128, 256 * std::int64_t{ y } + 128 };
        std::vector<int> found;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const auto& t = triangles[i];
            const int sum = side(t[0], t[1], centre) + side(t[1], t[2], centre) + side(t[2], t[0], centre);
            if (sum == 3 || sum == -3) {
                found.push_back(static_cast<int>(i));
            }
        }
        return found;
    }
    // The triangles in either order, on rows in either direction. The projection maps coordinates to pixels exactly where the
    // sides are powers of two.
    ao::picture draw(bool reversed, ao::first_row rows, const ao::cpu::options& o) const
    {
        world w;
        for (const auto& t : triangles) {
            mesh_data m;
            for (const fixed_point& p : t) {
                const auto y = static_cast<double>(p.y) / 256;
                m.positions.push_back(
                    { static_cast<double>(p.x) / 256, rows == ao::first_row::at_ndc_minus_one ? y : height - y, -1.0F });
            }
            m.indices = { 0, 1, 2 };
            w.meshes.push_back(m);
        }
        const int count = static_cast<int>(triangles.size());
        for (int i = 0; i < count; ++i) {
            w.add(reversed ? count - 1 - i : i, 0, glm::mat4(1));
        }
        ao::gbuffer_facts f;
        f.width = width;
        f.height = height;
        f.ids = true;
        f.normal = false;
        ao::gbuffer_camera camera;
        camera.projection = ao::make_projection({ 0, static_cast<double>(width), 0, static_cast<double>(height), 0.5, 10 },
                                                { .rows = rows, .parallel = true });
        auto cpu = cpu_test::rasterizer(o);
        return cpu_test::draw(cpu, w.get(), f, camera).ids;
    }
    // Every pixel shows the first triangle that covers it, in either order. Returns the pixels that more than one covers.
    int check(ao::first_row rows, const ao::cpu::options& o) const
    {
        const ao::picture forward = draw(false, rows, o);
        const ao::picture backward = draw(true, rows, o);
        int shared = 0;
        int wrong = 0;
        const int count = static_cast<int>(triangles.size());
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
                const std::vector<int> found = covering(x, y);
                shared += found.size() > 1 ? 1 : 0;
                const int first = found.empty() ? 0 : found.front() + 1;
                const int last = found.empty() ? 0 : count - found.back();
                wrong += static_cast<int>(forward.texel<glm::uvec2>(i).x) == first ? 0 : 1;
                wrong += static_cast<int>(backward.texel<glm::uvec2>(i).x) == last ? 0 : 1;
            }
        }
        CHECK(wrong == 0);
        return shared;
    }
};

std::array<ao::first_row, 2> both_rows()
{
    return { ao::first_row::at_ndc_minus_one, ao::first_row::at_ndc_plus_one };
}

} // namespace

TEST_CASE("triangles of a mesh cover each pixel of it exactly once, whatever their winding, diagonals and corners")
{
    std::mt19937 random(7);
    const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
    for (const int kind : { 0, 1, 2 }) {
        // A grid of convex cells whose corners are moved: anywhere, to pixel centres and corners, or so that many edges are
        // upright or level.
        constexpr int columns = 14;
        constexpr int rows = 9;
        flat_scene scene{ 64, 32, {} };
        std::array<std::array<fixed_point, columns + 1>, rows + 1> corners;
        for (int j = 0; j <= rows; ++j) {
            for (int i = 0; i <= columns; ++i) {
                const int dx = kind == 2 ? 0 : below(560) - 280;
                const int dy = kind == 2 && i % 2 == 0 ? 0 : below(460) - 230;
                fixed_point p{ i * 1400 - 1000 + dx, j * 1150 - 900 + dy };
                if (kind == 1) {
                    p = { (p.x + 100000) / 128 * 128 - 100000 / 128 * 128, (p.y + 100000) / 128 * 128 - 100000 / 128 * 128 };
                }
                corners[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = p;
            }
        }
        for (std::size_t j = 0; j < rows; ++j) {
            for (std::size_t i = 0; i < columns; ++i) {
                const std::array<fixed_point, 4> p{ corners[j][i], corners[j][i + 1], corners[j + 1][i + 1], corners[j + 1][i] };
                const std::size_t from = below(2) == 0 ? 0U : 1U;
                for (const std::size_t k : { from, from + 2 }) {
                    std::array<fixed_point, 3> t{ p[k % 4], p[(k + 1) % 4], p[(k + 2) % 4] };
                    std::rotate(t.begin(), t.begin() + below(3), t.end());
                    if (below(2) == 0) {
                        std::swap(t[0], t[1]);
                    }
                    scene.triangles.push_back(t);
                }
            }
        }
        for (const auto rows_from : both_rows()) {
            for (const ao::cpu::options& o : divisions()) {
                INFO("kind " << kind << ", tiles of " << o.tile_width << "x" << o.tile_height);
                CHECK(scene.check(rows_from, o) == 0);
            }
        }
    }
}

TEST_CASE("random triangles, slivers and degenerate ones cover what exact tests say")
{
    std::mt19937 random(8);
    const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
    flat_scene scene{ 64, 32, {} };
    for (int i = 0; i < 300; ++i) {
        // Far outside to within, thin, small, without area.
        const int reach = i % 3 == 0 ? 200000 : i % 3 == 1 ? 16000 : 700;
        const fixed_point a{ below(64 * 256 + reach) - reach / 2, below(32 * 256 + reach) - reach / 2 };
        const fixed_point b{ a.x + below(2 * reach) - reach, a.y + below(2 * reach) - reach };
        fixed_point c{ a.x + below(2 * reach) - reach, a.y + below(2 * reach) - reach };
        if (i % 5 == 0) {
            c = { (a.x + b.x) / 2 + below(5) - 2, (a.y + b.y) / 2 + below(5) - 2 };
        }
        if (i % 50 == 0) {
            c = b;
        }
        scene.triangles.push_back({ a, b, c });
    }
    int shared = 0;
    for (const auto rows : both_rows()) {
        for (const ao::cpu::options& o : divisions()) {
            shared += scene.check(rows, o);
        }
    }
    CHECK(shared > 0);
}

TEST_CASE("the widest pictures are covered as exactly")
{
    std::mt19937 random(9);
    const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
    flat_scene scene{ 65536, 4, {} };
    constexpr int right = 65536 * 256;
    for (int i = 0; i < 40; ++i) {
        scene.triangles.push_back(
            { { { below(2000) - 1000, below(1024) }, { right - below(2000), below(1024) }, { below(right), below(1024) } } });
    }
    CHECK(scene.check(ao::first_row::at_ndc_minus_one, {}) > 0);
    CHECK(scene.check(ao::first_row::at_ndc_plus_one, { .tile_width = 3, .tile_height = 1 }) > 0);
}

TEST_CASE("triangles without area in space close the gaps that snapping opens at T-junctions")
{
    std::mt19937 random(10);
    const auto unit = [&] { return std::uniform_real_distribution<float>(0.0F, 1.0F)(random); };
    auto cpu = cpu_test::rasterizer();
    ao::gbuffer_facts f;
    f.width = 64;
    f.height = 48;
    f.ids = f.position = true;
    f.normal = false;
    ao::gbuffer_camera camera;
    camera.projection = ao::make_projection({ -0.5, 0.5, -0.5, 0.5, 0.5, 10 });
    std::size_t by_fillers = 0;
    for (int i = 0; i < 100; ++i) {
        // A tilted quad a c b d beyond the picture, with m on a b in the half below only.
        world w;
        mesh_data m;
        const auto plane = [](float x, float y) { return glm::vec3(x, y, -2 + 0.3F * x + 0.2F * y); };
        const glm::vec3 a = plane(-2, unit() - 0.5F);
        const glm::vec3 b = plane(2, unit() - 0.5F);
        const float t = unit();
        m.positions = { a, b, plane(0, 8), plane(0, -8), a * (1 - t) + b * t };
        m.indices = { 0, 1, 2, 0, 4, 3, 4, 1, 3 };
        mesh_data filler = m;
        filler.indices = { 0, 4, 1 };
        w.meshes = { m, filler };
        w.add(0, 0, glm::mat4(1));
        w.add(1, 0, glm::mat4(1));
        const drawn d = cpu_test::draw(cpu, w.get(), f, camera);
        for (std::size_t p = 0; p < d.ids.pixels(); ++p) {
            const auto id = d.ids.texel<glm::uvec2>(p).x;
            REQUIRE(id != 0);
            by_fillers += id == 2 ? 1 : 0;
            const auto at = d.position.texel<glm::vec4>(p);
            REQUIRE(std::abs(plane(at.x, at.y).z - at.z) < 1e-4F);
        }
    }
    CHECK(by_fillers > 0);
}
