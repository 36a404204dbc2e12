// A glowing colour, scaled by the perspective-correct intensity.
#version 450
layout(location = 0) in float intensity;
layout(location = 0) out vec4 color;

void main() { color = vec4(vec3(1.0, 0.55, 0.15) * intensity, 1.0); }
