#include "body/direct_contact.hpp"

namespace devlearn {
namespace {

#ifdef DEVLEARN_DIRECT_CONTACTS
constexpr bool kAsked = true;
#else
constexpr bool kAsked = false;
#endif

// The one place where the body touches something.
struct Contact {
  const b2Shape* surface = nullptr;
  b2Manifold manifold;

  // Where it leads out, at a place of the body.
  b2Vec2 normal(b2Vec2 place) const {
    if (manifold.type != b2Manifold::e_circles) return manifold.localNormal;
    b2Vec2 outwards = place - manifold.localPoint;
    outwards.Normalize();
    return outwards;
  }
};

// Impulses take away what leads into the surface, and never pull: b2ContactSolver's
// SolveVelocityConstraints.
void solve_velocity(b2Vec2& velocity, b2Vec2 normal, float mass, int iterations) {
  const float inverse_mass = 1.0f / mass, normal_mass = 1.0f / inverse_mass;
  float impulse = 0.0f;
  for (int i = 0; i < iterations; ++i) {
    const float sum = b2Max(impulse - normal_mass * b2Dot(velocity, normal), 0.0f);
    const float added = sum - impulse;
    if (added == 0.0f) return;
    impulse = sum;
    velocity += inverse_mass * (added * normal);
  }
}

// What lies deeper than the slop is pushed out, a part an iteration: SolvePositionConstraints.
void solve_position(b2Vec2& place, const Contact& contact, float radius, float mass) {
  const float inverse_mass = 1.0f / mass;
  for (int i = 0; i < kPositionIterations; ++i) {
    const b2Vec2 normal = contact.normal(place);
    const float separation =
        b2Dot(place - contact.manifold.localPoint, normal) - contact.surface->m_radius - radius;
    const float push =
        b2Clamp(b2_baumgarte * (separation + b2_linearSlop), -b2_maxLinearCorrection, 0.0f);
    place += inverse_mass * ((-push / inverse_mass) * normal);
    if (separation >= -3.0f * b2_linearSlop) return;
  }
}

// Whether the Box2D at hand rounds every product before it adds it up, as it does unless its
// compiler fused the two. (Its version is looked at when building: what 2.4.1 says of itself is
// 2.4.0.)
bool box2d_fuses_nothing() {
  b2Transform ground, at;
  ground.SetIdentity();
  at.SetIdentity();
  b2Manifold manifold;
  manifold.type = b2Manifold::e_circles;
  manifold.pointCount = 1;
  manifold.localPoint.Set(0.3f, 0.7f);
  manifold.points[0].localPoint.SetZero();
  for (int i = 1; i <= 32; ++i) {
    at.p.Set(1.1f * static_cast<float>(i), 0.9f);
    const float radius = 0.1f * static_cast<float>(i);
    b2WorldManifold place;
    place.Initialize(&manifold, ground, radius, at, radius);
    b2Vec2 normal = at.p - manifold.localPoint;
    normal.Normalize();
    const b2Vec2 near = manifold.localPoint + radius * normal, far = at.p - radius * normal;
    if (!(place.points[0] == 0.5f * (near + far))) return false;
    if (place.separations[0] != b2Dot(far - near, normal)) return false;
  }
  return true;
}

}  // namespace

bool solves_directly() {
  static const bool same = kAsked && box2d_fuses_nothing();
  return same;
}

// b2World::Step with one contact. What it multiplies by zero here (turning, friction, restitution,
// the ground's motion) is left out.
std::optional<Drive> drive_directly(const Scene& scene, int iterations) {
  if (!solves_directly()) return std::nullopt;
  b2MassData mass;
  scene.body.ComputeMass(&mass, Scene::kDensity);
  b2Transform ground, at;
  ground.SetIdentity();
  at.SetIdentity();
  b2Vec2 velocity = scene.velocity;
  Contact contact;
  for (int i = 0; i < scene.substeps; ++i) {
    bool touching = false, several = false;
    const auto meet = [&](auto collide, const auto& surface) {
      b2Manifold manifold;
      collide(&manifold, &surface, ground, &scene.body, at);
      if (manifold.pointCount == 0) return;
      several = several || (contact.surface != nullptr && contact.surface != &surface);
      touching = true;
      contact = {&surface, manifold};
    };
    for (const b2EdgeShape& edge : scene.edges) meet(b2CollideEdgeAndCircle, edge);
    for (const b2CircleShape& circle : scene.circles) meet(b2CollideCircles, circle);
    if (several) return std::nullopt;

    const b2Vec2 place = at.p, before = velocity;
    if (touching) solve_velocity(velocity, contact.normal(at.p), mass.mass, iterations);
    at.p += scene.substep * velocity;
    if (touching) solve_position(at.p, contact, scene.body.m_radius, mass.mass);
    if (at.p == place && velocity == before) break;  // and so would all others
  }
  return Drive{{at.p.x, at.p.y}, contact.surface != nullptr};
}

}  // namespace devlearn
