// Light reflected by a standard material, in linear RGB. Directions and positions are along the world's axes with the origin at
// the eye, so that large scenes keep precision. Exactness: E, but Q where vectors are normalised or attenuated.

struct ao_surface {
    vec3 position;
    vec3 normal; // unit
    vec3 to_eye; // unit
    vec2 uv;
    real footprint;  // squared length of the longer screen derivative of uv
    real side;       // +1 seen from the front, -1 from behind
    real visibility; // 1 - occlusion: 1 = open. Scales the ambient term and nothing else
    vec3 opening;    // unit: where ambient light comes from: the normal, or the mean unoccluded direction
};

// Reflectances with their maps multiplied in.
struct ao_reflectance {
    vec3 ambient;
    vec3 diffuse;
    vec3 specular;
    real shininess; // 0 to 8192
    bool phong;     // else Blinn
};

struct ao_light {
    vec3 vector;      // unit, towards the light (directional), or its position (point)
    vec3 color;       // linear
    vec3 attenuation; // 1 / (x + y d + z d^2), point lights
    bool point;
};

// What of a light arrives at a point.
struct ao_incident {
    vec3 direction; // unit, towards the light
    vec3 color;
};

// Ambient light by direction n of the normal: a polynomial, which is what real spherical harmonics of order 2 are.
struct ao_ambient_light {
    vec3 constant;
    vec3 y;
    vec3 z;
    vec3 x;
    vec3 xy;
    vec3 yz;
    vec3 zz; // of 3 z^2 - 1
    vec3 xz;
    vec3 xx_yy; // of x^2 - y^2
};

AO_FN vec3 ao_scaled(vec3 v, real factor)
{
    AO_PRECISE vec3 product = vec3(v.x * factor, v.y * factor, v.z * factor);
    return product;
}

AO_FN vec3 ao_product(vec3 a, vec3 b)
{
    AO_PRECISE vec3 product = vec3(a.x * b.x, a.y * b.y, a.z * b.z);
    return product;
}

AO_FN vec3 ao_sum(vec3 a, vec3 b)
{
    AO_PRECISE vec3 sum = vec3(a.x + b.x, a.y + b.y, a.z + b.z);
    return sum;
}

// Never negative, 0 for NaN.
AO_FN vec3 ao_ambient(ao_ambient_light light, vec3 n)
{
    AO_PRECISE real xy = n.x * n.y;
    AO_PRECISE real yz = n.y * n.z;
    AO_PRECISE real zz = real(3) * n.z * n.z - real(1);
    AO_PRECISE real xz = n.x * n.z;
    AO_PRECISE real xx_yy = n.x * n.x - n.y * n.y;
    AO_PRECISE vec3 linear = vec3(light.constant.x + light.y.x * n.y + light.z.x * n.z + light.x.x * n.x,
                                  light.constant.y + light.y.y * n.y + light.z.y * n.z + light.x.y * n.x,
                                  light.constant.z + light.y.z * n.y + light.z.z * n.z + light.x.z * n.x);
    AO_PRECISE vec3 sum =
        vec3(linear.x + light.xy.x * xy + light.yz.x * yz + light.zz.x * zz + light.xz.x * xz + light.xx_yy.x * xx_yy,
             linear.y + light.xy.y * xy + light.yz.y * yz + light.zz.y * zz + light.xz.y * xz + light.xx_yy.y * xx_yy,
             linear.z + light.xy.z * xy + light.yz.z * yz + light.zz.z * zz + light.xz.z * xz + light.xx_yy.z * xx_yy);
    vec3 light_of_n =
        vec3(mix(real(0), sum.x, sum.x > real(0)), mix(real(0), sum.y, sum.y > real(0)), mix(real(0), sum.z, sum.z > real(0)));
    return light_of_n;
}

AO_FN ao_incident ao_light_at(ao_light light, ao_surface s)
{
    if (!light.point) {
        ao_incident far = { light.vector, light.color };
        return far;
    }
    AO_PRECISE vec3 towards = vec3(light.vector.x - s.position.x, light.vector.y - s.position.y, light.vector.z - s.position.z);
    AO_PRECISE real squared = ao_dot(towards, towards);
    real distance = sqrt(squared);
    AO_PRECISE real weakening = light.attenuation.x + light.attenuation.y * distance + light.attenuation.z * squared;
    mask weaker = weakening > real(1e-12);
    AO_PRECISE real strength = real(1) / mix(real(1e-12), weakening, weaker);
    ao_incident near = { ao_normalize_or(towards, s.normal), ao_scaled(light.color, strength) };
    return near;
}

// d mirrored at the plane with unit normal n; both point away from it.
AO_FN vec3 ao_mirrored(vec3 d, vec3 n)
{
    AO_PRECISE real twice = real(2) * ao_dot(d, n);
    AO_PRECISE vec3 direction = vec3(n.x * twice - d.x, n.y * twice - d.y, n.z * twice - d.z);
    return direction;
}

// Strength of the highlight in 0 ... 1: Phong 1975, (r . v)^e with r the mirrored light; Blinn 1977, (n . h)^e with h halfway
// between light and eye.
AO_FN real ao_highlight(ao_reflectance m, vec3 n, vec3 to_light, vec3 to_eye)
{
    if (m.phong) {
        AO_PRECISE real along = ao_dot(ao_mirrored(to_light, n), to_eye);
        return ao_power(along, m.shininess);
    }
    AO_PRECISE real near = ao_dot(ao_normalize_or(ao_sum(to_light, to_eye), n), n);
    return ao_power(near, m.shininess);
}

// Diffuse and specular light; nothing from behind the surface.
AO_FN vec3 ao_reflected(ao_reflectance m, ao_surface s, ao_incident light)
{
    AO_PRECISE real cosine = ao_dot(s.normal, light.direction);
    mask lit = cosine > real(0);
    vec3 diffuse = ao_scaled(m.diffuse, mix(real(0), cosine, lit));
    real highlight = mix(real(0), ao_highlight(m, s.normal, light.direction, s.to_eye), lit);
    return ao_product(ao_sum(diffuse, ao_scaled(m.specular, highlight)), light.color);
}

AO_FN vec3 ao_ambient_term(ao_reflectance m, ao_surface s, ao_ambient_light light)
{
    return ao_scaled(ao_product(m.ambient, ao_ambient(light, s.opening)), s.visibility);
}

// Visibility with the light that surfaces of this albedo send on to each other: the cubic of Jimenez, Wu, Pesce and Jarabo,
// "Practical Realtime Strategies for Accurate Indirect Occlusion" (2016), section 5. `visibility` in [0, 1]; `albedo` is taken in
// [0, 1]. Never below `visibility` nor above 1; at albedo 0 visibility itself, within 1e-5.
AO_FN real ao_bounced_visibility(real visibility, real albedo)
{
    real some = min(max(albedo, real(0)), real(1));
    AO_PRECISE real a = real(2.0404) * some - real(0.3324);
    AO_PRECISE real b = real(0.6417) - real(4.7951) * some;
    AO_PRECISE real c = real(2.7552) * some + real(0.6903);
    AO_PRECISE real cubic = ((a * visibility + b) * visibility + c) * visibility;
    return min(max(cubic, visibility), real(1));
}

// The ambient term with visibility tinted by the diffuse reflectance, which stands for that of the surfaces around.
AO_FN vec3 ao_bounced_ambient_term(ao_reflectance m, ao_surface s, ao_ambient_light light)
{
    vec3 visible = vec3(ao_bounced_visibility(s.visibility, m.diffuse.x), ao_bounced_visibility(s.visibility, m.diffuse.y),
                        ao_bounced_visibility(s.visibility, m.diffuse.z));
    return ao_product(ao_product(m.ambient, ao_ambient(light, s.opening)), visible);
}

// Where an equirectangular map shows a direction (of length about 1): the middle of the picture is -Z, right of it +X, its
// first row +Y.
AO_FN vec2 ao_equirectangular(vec3 d)
{
    AO_PRECISE real u = real(0.5) + ao_turns(d.x, -d.z);
    AO_PRECISE real level = d.x * d.x + d.z * d.z;
    AO_PRECISE real v = real(2) * ao_turns(sqrt(level), d.y);
    vec2 uv = vec2(u, v);
    return uv;
}
