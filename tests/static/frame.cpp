// Tangent frames as constant expressions: orthonormal for every pair, the fallback included (numerics.md T1, T2).
// NaN and infinity are no results of constant expressions: tests/unit/core_frame.cpp.
#include "static/support.hpp"

namespace {

using namespace static_test;

template <class Real>
struct suite {
    using m = ao::math<Real>;
    using vec3 = typename m::vec3;
    static constexpr Real third = Real(0.57735026918962576451);
    static constexpr Real minus_zero = -Real(0);

    static constexpr Real tangent_error(const vec3& n)
    {
        const vec3 t = m::ao_any_tangent(n);
        return frame_error<Real>({ t, m::ao_cross(n, t), n });
    }
    static_assert(tangent_error(vec3(0, 0, 1)) == 0);
    static_assert(tangent_error(vec3(0, 0, -1)) == 0);
    static_assert(tangent_error(vec3(1, 0, 0)) == 0);
    static_assert(tangent_error(vec3(1, 0, minus_zero)) == 0);
    static_assert(tangent_error(vec3(minus_zero, -1, minus_zero)) == 0);
    static_assert(tangent_error(vec3(third, third, -third)) < Real(4e-7));
    static_assert(tangent_error(vec3(Real(1e-4), 0, Real(-0.999999995))) < Real(4e-7));
    static constexpr vec3 of_nothing = m::ao_any_tangent(vec3(0, 0, 0));
    static_assert(of_nothing.x == 1 && of_nothing.y == 0 && of_nothing.z == 0);

    static constexpr Real gram_schmidt_error(const vec3& n, const vec3& helper)
    {
        return frame_error<Real>(m::ao_gram_schmidt(n, helper));
    }
    static constexpr bool every_helper(const vec3& n)
    {
        Real worst = 0;
        for (const vec3& helper : { n, -n, vec3(0, 0, 0), vec3(Real(1e-18), 0, 0), vec3(Real(1e18), 0, 0), vec3(1, 0, 0),
                                    vec3(Real(-0.7), Real(0.2), 0), n + vec3(Real(1e-6), 0, 0), n + vec3(0, Real(0.06), 0) }) {
            const Real e = gram_schmidt_error(n, helper);
            worst = e > worst ? e : worst;
        }
        return worst < Real(1e-5);
    }
    static_assert(every_helper(vec3(0, 0, 1)));
    static_assert(every_helper(vec3(0, 0, -1)));
    static_assert(every_helper(vec3(1, 0, 0)));
    static_assert(every_helper(vec3(0, -1, minus_zero)));
    static_assert(every_helper(vec3(third, -third, third)));
    static_assert(every_helper(vec3(Real(0.6), 0, Real(-0.8))));

    // Away from the fallback the tangent is the helper without its part along the normal.
    static constexpr typename m::ao_frame plain = m::ao_gram_schmidt(vec3(0, 0, 1), vec3(Real(0.5), 0, Real(0.25)));
    static_assert(equal(plain.tangent, vec3(1, 0, 0)) && equal(plain.bitangent, vec3(0, 1, 0)) &&
                  equal(plain.normal, vec3(0, 0, 1)));
    // Parallel: the fallback.
    static_assert(equal(m::ao_gram_schmidt(vec3(0, 0, 1), vec3(0, 0, 1)).tangent, m::ao_any_tangent(vec3(0, 0, 1))));
};

template struct suite<float>;
template struct suite<double>;

} // namespace
