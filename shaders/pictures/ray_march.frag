// Spheres on a ground, found by marching along rays: nested function calls, early returns and loops that end at
// different times.
#version 450
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

struct Hit {
  float distance;
  int material;  // 0 nothing, 1 ground, 2 stones
};

float stones(vec3 p) {
  float nearest = 1e9;
  for (int i = 0; i < 4; ++i) {
    float turn = float(i) * 1.7;
    vec3 center = vec3(1.3 * cos(turn), 0.15 * float(i) - 0.1, 1.3 * sin(turn) + 1.0);
    nearest = min(nearest, length(p - center) - (0.62 - 0.08 * float(i)));
  }
  return nearest;
}

Hit nearest(vec3 p) {
  float ground = p.y + 0.6;
  float stone = stones(p);
  return stone < ground ? Hit(stone, 2) : Hit(ground, 1);
}

Hit march(vec3 origin, vec3 direction) {
  float way = 0.0;
  for (int i = 0; i < 80; ++i) {
    Hit hit = nearest(origin + way * direction);
    if (hit.distance < 1e-3) return Hit(way, hit.material);
    way += hit.distance;
    if (way > 14.0) break;
  }
  return Hit(way, 0);
}

vec3 normal_at(vec3 p) {
  const vec2 e = vec2(2e-3, 0.0);
  return normalize(vec3(nearest(p + e.xyy).distance - nearest(p - e.xyy).distance,
                        nearest(p + e.yxy).distance - nearest(p - e.yxy).distance,
                        nearest(p + e.yyx).distance - nearest(p - e.yyx).distance));
}

float soft_shadow(vec3 origin, vec3 light) {
  float lit = 1.0;
  float way = 0.03;
  while (way < 5.0) {
    float free = stones(origin + way * light);
    if (free < 1e-3) return 0.0;
    lit = min(lit, 8.0 * free / way);
    way += clamp(free, 0.02, 0.4);
  }
  return lit;
}

vec3 sky(vec3 direction) { return mix(vec3(0.95, 0.62, 0.38), vec3(0.16, 0.24, 0.48), smoothstep(-0.05, 0.6, direction.y)); }

vec3 shade(vec3 origin, vec3 direction, Hit hit) {
  if (hit.material == 0) return sky(direction);
  const vec3 light = normalize(vec3(0.6, 0.7, -0.5));
  vec3 p = origin + hit.distance * direction;
  vec3 normal = normal_at(p);
  vec3 albedo = vec3(0.75, 0.28, 0.16);
  if (hit.material == 1) {
    float checker = mod(floor(p.x * 1.5) + floor(p.z * 1.5), 2.0);
    albedo = mix(vec3(0.30, 0.28, 0.30), vec3(0.55, 0.52, 0.50), checker);
  }
  float diffuse = max(dot(normal, light), 0.0) * soft_shadow(p + 0.01 * normal, light);
  float highlight = hit.material == 2 ? pow(max(dot(reflect(direction, normal), light), 0.0), 24.0) : 0.0;
  vec3 lit = albedo * (0.25 + 0.85 * diffuse) + 0.4 * highlight;
  return mix(lit, sky(direction), 1.0 - exp(-0.012 * hit.distance * hit.distance));
}

void main() {
  vec3 origin = vec3(0.0, 0.7, -3.2);
  vec3 direction = normalize(vec3(place, 1.6) - vec3(0.0, 0.25, 0.0));
  color = vec4(sqrt(shade(origin, direction, march(origin, direction))), 1.0);
}
