#include "conformance/runners.hpp"
#include "conformance/suite.hpp"

#include <catch2/catch.hpp>

using namespace ao::host;

#ifdef AO_HAS_CPU

TEST_CASE("cpu: every width conforms")
{
    using ao::cpu::width;
    for (const width w : { width::scalar, width::lanes4, width::lanes8, width::lanes16 }) {
        if (!ao::cpu::is_available(w)) {
            WARN("skipped: this processor or build has no " << ao::cpu::name_of(w));
            continue;
        }
        const auto runner = require_runner(make_cpu_runner({ .lanes = w }));
        CHECK(runner->exact());
        check_suite(*runner);
    }
}

TEST_CASE("cpu: any number of threads and any tiles give the same bits")
{
    for (const int threads : { 1, 2, 3, 7 }) {
        const auto runner =
            require_runner(make_cpu_runner({ .threads = threads, .tile_width = 5 + threads, .tile_height = threads }));
        check_suite(*runner, { .functions = false });
    }
}

#endif

#ifdef AO_HAS_GL

TEST_CASE("gl: both routes and both kinds of shader conform")
{
    using namespace ao::gl;
    for (const route by : { route::compute, route::fragment }) {
        for (const shader_source source : { shader_source::spirv, shader_source::text }) {
            const auto runner = require_runner(make_gl_runner({}, { .route = by, .source = source }));
            INFO(runner->name());
            CHECK(runner->exact());
            check_suite(*runner);
        }
    }
}

TEST_CASE("gl: any group size gives the same bits")
{
    for (const auto& [x, y] : { std::pair(1U, 1U), std::pair(7U, 5U), std::pair(64U, 2U) }) {
        const auto runner = require_runner(make_gl_runner({}, { .group_width = x, .group_height = y }));
        check_suite(*runner, { .functions = false });
    }
}

#endif

#ifdef AO_HAS_VK

TEST_CASE("vk: conforms under validation and synchronisation validation, which stay silent")
{
    const auto runner = require_runner(make_vk_runner({ .device = {}, .validation = true }));
    CHECK(runner->exact());
    check_suite(*runner);
    for (const std::string& message : runner->messages()) {
        FAIL_CHECK(message);
    }
}

TEST_CASE("vk: any group size gives the same bits")
{
    for (const ao::vk::group_size group :
         { ao::vk::group_size{ 1, 1 }, ao::vk::group_size{ 7, 5 }, ao::vk::group_size{ 64, 2 } }) {
        const auto runner = require_runner(make_vk_runner({ .device = {}, .group = group }));
        check_suite(*runner, { .functions = false });
    }
}

#endif
