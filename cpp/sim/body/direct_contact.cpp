#include "body/direct_contact.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace devlearn {
namespace {

#ifdef DEVLEARN_DIRECT_CONTACTS
constexpr bool kAsked = true;
#else
constexpr bool kAsked = false;
#endif

b2AABB square(b2Vec2 centre, float half) {
  const b2Vec2 corner{half, half};
  return {centre - corner, centre + corner};
}

// A surface that the body touches, and what keeps the body out of it.
struct Contact {
  std::size_t surface;  // its number in the scene
  float radius;         // its own
  b2Manifold manifold;
  b2Vec2 outwards{0.0f, 0.0f};  // normal() where the substep begins
  float impulse = 0.0f;

  // Where it leads out, at a place of the body.
  b2Vec2 normal(b2Vec2 place) const {
    if (manifold.type != b2Manifold::e_circles) return manifold.localNormal;
    b2Vec2 away = place - manifold.localPoint;
    away.Normalize();
    return away;
  }
};

// The order in which Box2D solves a body's contacts: that of its list of what its tree of boxes
// finds near, which grows at the front. b2BroadPhase, b2ContactManager.
class SolvingOrder {
 public:
  // For a body that went along these places.
  SolvingOrder(const Scene& scene, const std::vector<b2Vec2>& trail)
      : radius_(scene.body.m_radius) {
    for (const b2AABB& bound : scene.bounds) proxies_.push_back(tree_.CreateProxy(bound, nullptr));
    body_ = tree_.CreateProxy(bound(trail.front()), nullptr);
    find();
    for (std::size_t i = 1; i < trail.size(); ++i) follow(trail[i - 1], trail[i]);
  }

  // b2Fixture::Synchronize
  void follow(b2Vec2 from, b2Vec2 to) {
    const b2AABB begin = bound(from), end = bound(to);
    b2AABB swept;
    swept.Combine(begin, end);
    if (tree_.MoveProxy(body_, swept, end.GetCenter() - begin.GetCenter())) find();
  }

  void sort(std::vector<Contact>& contacts) const {
    const auto rank = [this](const Contact& contact) {
      return std::find(near_.begin(), near_.end(), proxies_[contact.surface]);
    };
    std::sort(contacts.begin(), contacts.end(),
              [&](const Contact& a, const Contact& b) { return rank(a) < rank(b); });
  }

  // Of b2DynamicTree::Query.
  bool QueryCallback(std::int32_t proxy) {
    const bool known = std::find(near_.begin(), near_.end(), proxy) != near_.end();
    if (proxy != body_ && !known) near_.insert(near_.begin(), proxy);
    return true;
  }

 private:
  b2AABB bound(b2Vec2 place) const { return square(place, radius_); }
  void find() {
    const b2AABB& body = tree_.GetFatAABB(body_);
    const auto apart = [&](std::int32_t proxy) {
      return !b2TestOverlap(tree_.GetFatAABB(proxy), body);
    };
    near_.erase(std::remove_if(near_.begin(), near_.end(), apart), near_.end());
    tree_.Query(this, body);
  }

  float radius_;  // the body's
  b2DynamicTree tree_;
  std::vector<std::int32_t> proxies_, near_;
  std::int32_t body_;
};

// Impulses take away what leads into the surfaces, and never pull: b2ContactSolver's
// SolveVelocityConstraints.
void solve_velocity(b2Vec2& velocity, std::vector<Contact>& contacts, float mass, int iterations) {
  const float inverse_mass = 1.0f / mass, normal_mass = 1.0f / inverse_mass;
  bool changed = true;
  for (int i = 0; i < iterations && changed; ++i) {
    changed = false;
    for (Contact& contact : contacts) {
      const float sum =
          b2Max(contact.impulse - normal_mass * b2Dot(velocity, contact.outwards), 0.0f);
      const float added = sum - contact.impulse;
      contact.impulse = sum;
      velocity += inverse_mass * (added * contact.outwards);
      changed = changed || added != 0.0f;
    }
  }
}

// What lies deeper than the slop is pushed out, a part an iteration: SolvePositionConstraints.
void solve_position(b2Vec2& place, const std::vector<Contact>& contacts, float radius, float mass) {
  const float inverse_mass = 1.0f / mass;
  bool deep = true;
  for (int i = 0; i < kPositionIterations && deep; ++i) {
    deep = false;
    for (const Contact& contact : contacts) {
      const b2Vec2 normal = contact.normal(place);
      const float separation =
          b2Dot(place - contact.manifold.localPoint, normal) - contact.radius - radius;
      const float push =
          b2Clamp(b2_baumgarte * (separation + b2_linearSlop), -b2_maxLinearCorrection, 0.0f);
      place += inverse_mass * ((-push / inverse_mass) * normal);
      deep = deep || separation < -3.0f * b2_linearSlop;
    }
  }
}

void collide(b2Manifold& manifold, const b2EdgeShape& edge, const b2Transform& ground,
             const b2CircleShape& body, const b2Transform& at) {
  b2CollideEdgeAndCircle(&manifold, &edge, ground, &body, at);
}
void collide(b2Manifold& manifold, const b2CircleShape& circle, const b2Transform& ground,
             const b2CircleShape& body, const b2Transform& at) {
  b2CollideCircles(&manifold, &circle, ground, &body, at);
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

// b2World::Step. What it multiplies by zero here (turning, friction, restitution, the ground's
// motion) is left out.
std::optional<Drive> drive_directly(const Scene& scene, int iterations) {
  if (!solves_directly()) return std::nullopt;
  b2MassData mass;
  scene.body.ComputeMass(&mass, Scene::kDensity);
  b2Transform ground, at;
  ground.SetIdentity();
  at.SetIdentity();
  b2Vec2 velocity = scene.velocity;
  std::vector<b2Vec2> trail;  // where each substep began
  trail.reserve(static_cast<std::size_t>(scene.substeps));
  std::vector<Contact> contacts;
  std::optional<SolvingOrder> order;  // once it matters
  Drive drive;
  for (int i = 0; i < scene.substeps; ++i) {
    trail.push_back(at.p);
    const b2AABB near = square(at.p, scene.body.m_radius + b2_linearSlop);
    contacts.clear();
    const auto meet = [&](std::size_t surface, const auto& shape) {
      if (!b2TestOverlap(near, scene.bounds[surface])) return;
      Contact contact{surface, shape.m_radius, {}};
      collide(contact.manifold, shape, ground, scene.body, at);
      if (contact.manifold.pointCount == 0) return;
      contact.outwards = contact.normal(at.p);
      contacts.push_back(contact);
    };
    scene.for_each_surface(meet);
    drive.touched = drive.touched || !contacts.empty();
    if (order) {
      order->follow(trail[trail.size() - 2], at.p);
    } else if (contacts.size() > 1) {
      order.emplace(scene, trail);
    }
    if (contacts.size() > 1) order->sort(contacts);

    const b2Vec2 place = at.p, before = velocity;
    solve_velocity(velocity, contacts, mass.mass, iterations);
    at.p += scene.substep * velocity;
    solve_position(at.p, contacts, scene.body.m_radius, mass.mass);
    // Along a single surface the body gets through nothing.
    drive.passed = drive.passed || (order && scene.passes(place, at.p));
    if (at.p == place && velocity == before) break;  // and so would all others
  }
  drive.moved = {at.p.x, at.p.y};
  return drive;
}

}  // namespace devlearn
