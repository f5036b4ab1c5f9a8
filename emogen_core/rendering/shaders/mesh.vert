#version 330 core
// Light is computed here, once a vertex: on software GL the fragment stage is what costs.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texcoord;
layout(location = 3) in vec2 light;  // sight of the key light, translucency; eyes: way from the lamp's image, in radii
layout(location = 4) in vec4 tint;   // skin: occlusion, skin, gloss, wrinkles; eyes: lid shadow, nothing, catchlight's strength, way to the lower lid

uniform mat4 V;
uniform mat4 P;
uniform vec3 cam_pos;
uniform vec3 fade;  // height where the bust starts to fade, where it is gone, rise of both towards the sides (1/mm)
uniform float shine_scale;

out vec2 uv;
out vec3 diffuse;
out vec3 shine;
out vec2 extra;  // wrinkle activation (below 0: always wet), height against which the bust fades

#ifdef KIND_EYE
out vec3 ray;
out vec3 facing;
#endif

const vec3 KEY = normalize(vec3(-0.62, 0.62, 1.0));
const vec3 FILL = normalize(vec3(1.0, 0.12, 0.75));
const vec3 RIM = normalize(vec3(0.55, 0.55, -1.0));
const vec3 KEY_COLOUR = vec3(1.04, 0.972, 0.90);
const vec3 FILL_COLOUR = vec3(0.235, 0.25, 0.27);
const vec3 RIM_COLOUR = vec3(0.46, 0.475, 0.50);
const vec3 SKY = vec3(0.285, 0.295, 0.31);
const vec3 GROUND = vec3(0.13, 0.115, 0.105);
// Light that enters skin leaves it farther on, red farthest: the terminator is soft and red.
const vec3 WRAP = vec3(0.36, 0.16, 0.10);

vec3 lit(vec3 n, vec3 towards, vec3 wrap) {
    return clamp((vec3(dot(n, towards)) + wrap) / (1.0 + wrap), 0.0, 1.0);
}

float lobes(vec3 n, vec3 towards, vec3 view) {
    float h = clamp(dot(n, normalize(towards + view)), 0.0, 1.0);
    return 0.10 * pow(h, 14.0) + 0.17 * pow(h, 52.0);
}

void main() {
    vec3 n = normalize(normal);
    vec3 view = normalize(cam_pos - position);
    float skin = tint.y;
    // Teeth have a skin of next to nothing; light goes through their edges.
    float enamel = clamp(3.0 - 10.0 * skin, 0.0, 1.0);
    vec3 wrap = WRAP * (0.25 + 0.75 * skin) + 0.55 * enamel;
    // Shadows on flesh are warm, between teeth too: light that gets there has been reflected by flesh.
    vec3 occlusion = pow(vec3(max(tint.x, 0.001)), mix(vec3(0.84, 1.0, 1.14), vec3(0.72, 1.02, 1.10), skin));
    vec3 sight = pow(vec3(max(light.x, 0.001)), mix(vec3(0.84, 1.0, 1.14), vec3(0.70, 1.05, 1.20), skin));
    diffuse = KEY_COLOUR * sight * lit(n, KEY, wrap)
        + occlusion * (FILL_COLOUR * lit(n, FILL, wrap) + RIM_COLOUR * 0.75 * lit(n, RIM, wrap * 0.5)
        + mix(GROUND, SKY, n.y * 0.5 + 0.5));
    diffuse *= mix(vec3(1.0), occlusion, 0.48);
    float through = light.y * skin * (0.35 + 0.65 * clamp(dot(-n, RIM) * 0.5 + 0.5, 0.0, 1.0));
    diffuse += through * vec3(0.34, 0.07, 0.035);
    // Enamel lets light in and gives it back warm.
    diffuse *= 1.0 + enamel * vec3(0.07, 0.06, 0.05);
    float edge = pow(clamp(1.0 - clamp(dot(n, view), 0.0, 1.0), 0.0, 1.0), 4.0);
    float gloss = tint.z * shine_scale;
    shine = gloss * (KEY_COLOUR * light.x * lobes(n, KEY, view) + FILL_COLOUR * tint.x * lobes(n, FILL, view)
        + tint.x * edge * (0.06 * SKY + 0.22 * RIM_COLOUR * clamp(dot(n, RIM) + 0.45, 0.0, 1.0)));
    extra = vec2(skin < 0.85 ? -1.0 : tint.w, position.y - fade.z * position.x * position.x);
    uv = texcoord;
#ifdef KIND_EYE
    diffuse = tint.xyz;
    shine = vec3(light, 0.0);
    extra.x = tint.w;
    ray = view;
    facing = n;
#endif
    gl_Position = P * (V * vec4(position, 1.0));
}
