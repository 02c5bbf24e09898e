// What sweep/gbuffer_levels.cpp does at full length, in a size for every day.
#include "sweep/gbuffer_views.hpp"

TEST_CASE("the backends draw a view of each level alike, and shade alike what one of them drew")
{
    gbuffer_test::check_levels(320, 180, 1);
}

TEST_CASE("the backends draw the bundled scene alike, and shade alike what one of them drew")
{
    gbuffer_test::check_courtyard(320, 180);
}
