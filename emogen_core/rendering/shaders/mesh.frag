#version 330 core
struct Material {
    sampler2D base_color_texture;
};
uniform Material material;
uniform vec3 background;
uniform vec3 fade;
uniform vec3 tone;
uniform float breakup;  // how much of the shine a darker texel loses: 3.2 / green of the skin's tone

in vec2 uv;
in vec3 diffuse;
in vec3 shine;
in vec2 extra;
out vec4 colour;

#ifdef KIND_EYE
in vec3 ray;
in vec3 facing;
const vec3 KEY = normalize(vec3(-0.62, 0.62, 1.0));
const vec3 FILL = normalize(vec3(1.0, 0.12, 0.75));
#endif

// Bright parts run into white softly instead of clipping; then gamma 2, as the textures are stored.
vec3 developed(vec3 c) {
    vec3 above = c * (1.0 + 0.16 * c);
    vec3 below = 1.0 + 0.42 * c;
    // sqrt(above / below) without the division.
    return above * inversesqrt(max(above * below, 1e-6));
}

void main() {
    float gone = smoothstep(fade.x, fade.y, extra.y);
    vec4 texel = texture(material.base_color_texture, uv);
#ifdef KIND_LASH
    vec3 c = developed(tone * tone * diffuse);
    colour = vec4(c, texel.a * (1.0 - gone));
#else
    vec3 albedo = texel.rgb * texel.rgb;
#ifdef KIND_EYE
    vec3 n = normalize(facing);
    vec3 view = normalize(ray);
    float key = clamp(dot(n, KEY) * 0.62 + 0.38, 0.0, 1.0);
    float fill = clamp(dot(n, FILL) * 0.6 + 0.4, 0.0, 1.0);
    vec3 c = albedo * diffuse.x * (key * vec3(0.84, 0.80, 0.755) + fill * vec3(0.19, 0.20, 0.22) + 0.16);
    // The lamp is mirrored as what it is, a soft box: a rounded square, brightest at its upper side, with a glow.
    vec2 box = shine.xy * shine.xy;
    float window = 1.0 - smoothstep(0.0008, 0.0080, sqrt(dot(box, box) + 0.9 * box.x * box.y));
    float glow = 1.0 / (1.0 + 60.0 * (box.x + box.y));
    float g = clamp(dot(n, normalize(FILL + view)), 0.0, 1.0);
    c += diffuse.z * (mix(0.12, 1.0, texel.a) * (1.25 + 5.0 * shine.y) * window
        + smoothstep(0.34, 0.60, diffuse.x) * 0.06 * texel.a * smoothstep(0.955, 1.0, g) + 0.10 * glow * glow);
    // A line of tears lies on the lower lid.
    c += diffuse.z * key * 0.16 * smoothstep(0.005, 0.03, extra.x) * (1.0 - smoothstep(0.04, 0.085, extra.x));
    colour = vec4(mix(developed(c), background, gone), 1.0);
#else
    // What a fold's slope adds to the light or takes from it; in its shadow red light remains longest.
    float relief = (texel.a - 128.0 / 255.0) * 2.0 * extra.x;
    // Pores, hair and brows are darker than skin and shine less: that breaks the highlight up.
    // Hair lighter than the skin is matt, too; lips' insides, tongue and teeth are wet whatever their colour.
    float lightness = breakup * texel.g;
    float rough = extra.x < 0.0 ? 1.4 : clamp(min(lightness - 2.2, 6.4 - lightness), 0.10, 1.6);
    vec3 c = albedo * diffuse * (1.0 + relief * vec3(0.80, 1.0, 1.06)) + shine * rough * max(1.0 + 1.8 * relief, 0.0);
    colour = vec4(mix(developed(c), background, gone), 1.0);
#endif
#endif
}
