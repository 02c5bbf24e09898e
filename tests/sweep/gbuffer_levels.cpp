// Every view of the levels and of the bundled scene at full size.
#include "sweep/gbuffer_views.hpp"

TEST_CASE("the backends draw the levels alike, and shade alike what one of them drew")
{
    gbuffer_test::check_levels(1280, 720, 100);
}

TEST_CASE("the backends draw the bundled scene alike, and shade alike what one of them drew")
{
    gbuffer_test::check_courtyard(1280, 720);
}
