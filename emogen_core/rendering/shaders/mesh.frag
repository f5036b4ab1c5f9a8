#version 330 core
struct Material {
    sampler2D base_color_texture;
};
uniform Material material;
uniform vec3 background;
uniform vec3 tone;

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
// Where the key light is mirrored: nearer to the pupil than physics has it, so that narrowed eyes keep their light.
const vec3 CATCH = normalize(vec3(-0.17, 0.17, 1.0));
#endif

// Bright parts run into white softly instead of clipping; then gamma 2, as the textures are stored.
vec3 developed(vec3 c) {
    c *= (1.0 + 0.16 * c) / (1.0 + 0.42 * c);
    return sqrt(clamp(c, 0.0, 1.0));
}

void main() {
    vec4 texel = texture(material.base_color_texture, uv);
#ifdef KIND_LASH
    vec3 c = developed(tone * tone * diffuse);
    colour = vec4(c, texel.a * (1.0 - extra.y));
#else
    vec3 albedo = texel.rgb * texel.rgb;
#ifdef KIND_EYE
    vec3 n = normalize(facing);
    vec3 view = normalize(ray);
    float key = clamp(dot(n, KEY) * 0.62 + 0.38, 0.0, 1.0);
    float fill = clamp(dot(n, FILL) * 0.6 + 0.4, 0.0, 1.0);
    vec3 c = albedo * diffuse.x * (key * vec3(0.92, 0.89, 0.85) + fill * vec3(0.22, 0.235, 0.26) + 0.20);
    float h = clamp(dot(n, CATCH), 0.0, 1.0);
    float g = clamp(dot(n, normalize(FILL + view)), 0.0, 1.0);
    float open = smoothstep(0.34, 0.60, diffuse.x);
    c += open * (mix(0.10, 1.0, texel.a) * 1.5 * smoothstep(0.9925, 0.9965, h) + 0.10 * texel.a * smoothstep(0.975, 0.99, g)
        + 0.05 * pow(h, 40.0));
    colour = vec4(mix(developed(c), background, extra.y), 1.0);
#else
    // What a fold's slope adds to the light or takes from it; in its shadow red light remains longest.
    float relief = (texel.a - 0.5) * 2.0 * extra.x;
    // Pores, hair and brows are darker than skin and shine less: that breaks the highlight up.
    float rough = clamp(1.0 + 3.2 * (texel.g / max(tone.g, 0.05) - 1.0), 0.10, 1.6);
    vec3 c = albedo * diffuse * (1.0 + relief * vec3(0.80, 1.0, 1.06)) + shine * rough * max(1.0 + 1.8 * relief, 0.0);
    colour = vec4(mix(developed(c), background, extra.y), 1.0);
#endif
#endif
}
