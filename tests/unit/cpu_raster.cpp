// The CPU's geometry pass.
#include "unit/cpu_raster_support.hpp"

using namespace cpu_test;
using namespace raster_test;
using ao::cpu::view_of;

namespace {

draw_function with(ao::cpu::rasterizer& cpu)
{
    return [&](const auto& s, const auto& f, const auto& c) { return cpu_test::draw(cpu, s, f, c); };
}

} // namespace

TEST_CASE("the CPU draws what rays see: standard, reversed, infinite, parallel, either depth range and first row")
{
    auto cpu = cpu_test::rasterizer();
    check_targets(with(cpu));
}

TEST_CASE("the CPU's normal maps and alpha tests: mirrored UVs, mirrored and unevenly scaled models, either green")
{
    auto cpu = cpu_test::rasterizer();
    check_maps(with(cpu));
}

TEST_CASE("the CPU writes normals in every format")
{
    auto cpu = cpu_test::rasterizer();
    check_normal_formats(with(cpu));
}

TEST_CASE("the CPU draws a million objects, each with its own transform and id; an empty scene clears")
{
    auto cpu = cpu_test::rasterizer();
    check_many_objects(with(cpu), 1000000);
}
