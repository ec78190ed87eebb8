// Open Dynamics Engine: dWorldStep pivots to the end, dWorldQuickStep sweeps.
#include <ode/ode.h>

#include "tests/peers/engine.h"

namespace tumble::peers {

namespace {

/// What of ODE is set; these are its own defaults.
struct OdeSetup {
  int sweeps = 0;        ///< of dWorldQuickStep; 0: dWorldStep
  double erp = 0.2;      ///< share of an overlap that a step takes away
  double cfm = 1e-10;    ///< softness of all constraints
  int contacts = 8;      ///< of a pair, at most
  bool aligned = false;  ///< edges of the friction pyramid along and across the slip
  bool finite = false;   ///< rotations advance by finite angles
};

Vec3 fromOde(const dReal* v) {
  return {v[0], v[1], v[2]};
}

class Ode : public Engine {
 public:
  Ode(const Scene& scene, double h, const OdeSetup& setup) : setup_(setup), h_(h) {
    [[maybe_unused]] static const int ready = dInitODE2(0);
    dSetMessageHandler([](int, const char*, va_list) {});  // it tells each LCP that it cannot solve
    dRandSetSeed(0);                                       // the order of sweeps is drawn by lot
    surface_ = commonSurface(scene.world);
    world_ = dWorldCreate();
    space_ = dHashSpaceCreate(nullptr);
    group_ = dJointGroupCreate(0);
    const Vec3& g = scene.world.gravity;
    dWorldSetGravity(world_, g.x(), g.y(), g.z());
    dWorldSetERP(world_, setup.erp);
    dWorldSetCFM(world_, setup.cfm);
    dWorldSetQuickStepNumIterations(world_, setup.sweeps);
    for (const BodyDef& body : scene.world.bodies) add(body);
  }
  ~Ode() override {
    dJointGroupDestroy(group_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  void step() override {
    dSpaceCollide(space_, this,
                  [](void* self, dGeomID a, dGeomID b) { static_cast<Ode*>(self)->meet(a, b); });
    if (setup_.sweeps > 0) {
      dWorldQuickStep(world_, h_);
    } else {
      dWorldStep(world_, h_);
    }
    dJointGroupEmpty(group_);
  }

  void read(std::vector<BodySample>& bodies) const override {
    bodies.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!bodies_[i]) {
        bodies[i] = still_[i];
        continue;
      }
      const dReal* q = dBodyGetQuaternion(bodies_[i]);
      bodies[i] = {fromOde(dBodyGetPosition(bodies_[i])), Quat(q[0], q[1], q[2], q[3]),
                   fromOde(dBodyGetLinearVel(bodies_[i])), fromOde(dBodyGetAngularVel(bodies_[i]))};
    }
  }

 private:
  void add(const BodyDef& body) {
    still_.push_back({body.position, body.orientation});
    bodies_.push_back(nullptr);
    if (const auto* plane = std::get_if<HalfSpace>(&body.shape)) {
      dCreatePlane(space_, plane->n.x(), plane->n.y(), plane->n.z(), plane->d);
      return;
    }
    dGeomID geometry;
    if (const auto* ball = std::get_if<Sphere>(&body.shape)) {
      geometry = dCreateSphere(space_, ball->r);
    } else {
      const Vec3 edges = 2.0 * std::get<Box>(body.shape).half;
      geometry = dCreateBox(space_, edges.x(), edges.y(), edges.z());
    }
    if (!body.fixed) {
      bodies_.back() = dBodyCreate(world_);
      dGeomSetBody(geometry, bodies_.back());
      setMotion(body, bodies_.back());
    }
    const Quat& o = body.orientation;
    const dQuaternion q = {o.w(), o.x(), o.y(), o.z()};
    dGeomSetPosition(geometry, body.position.x(), body.position.y(), body.position.z());
    dGeomSetQuaternion(geometry, q);
  }

  void setMotion(const BodyDef& body, dBodyID made) {
    const MassProperties properties = massOf(body);
    const Mat3& I = properties.inertia;
    dMass mass;
    dMassSetParameters(&mass, properties.mass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2),
                       I(1, 2));
    dBodySetMass(made, &mass);
    const Vec3 &v = body.velocity, &w = body.angularVelocity;
    dBodySetLinearVel(made, v.x(), v.y(), v.z());
    dBodySetAngularVel(made, w.x(), w.y(), w.z());
    dBodySetFiniteRotationMode(made, setup_.finite);
  }

  // Makes a joint of each point where two geometries touch.
  void meet(dGeomID a, dGeomID b) {
    const dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
    if (!first && !second) return;
    constexpr int kMost = 16;
    dContactGeom points[kMost];
    const int count = dCollide(a, b, setup_.contacts, points, sizeof(dContactGeom));
    for (int k = 0; k < count; ++k) {
      dContact contact{};
      contact.geom = points[k];
      contact.surface.mode = dContactApprox1 | dContactBounce;
      contact.surface.mu = surface_.friction;
      contact.surface.bounce = surface_.restitution;
      if (setup_.aligned) align(contact, first, second);
      dJointAttach(dJointCreateContact(world_, group_, &contact), first, second);
    }
  }

  static Vec3 velocityAt(dBodyID body, const dReal* p) {
    if (!body) return Vec3::Zero();
    dVector3 v;
    dBodyGetPointVel(body, p[0], p[1], p[2], v);
    return fromOde(v);
  }

  // Along the slip, where there is any.
  static void align(dContact& contact, dBodyID first, dBodyID second) {
    constexpr double kSlip = 1e-6;  // [m/s]
    const Vec3 n = fromOde(contact.geom.normal);
    Vec3 slip = velocityAt(first, contact.geom.pos) - velocityAt(second, contact.geom.pos);
    slip -= n.dot(slip) * n;
    if (slip.norm() < kSlip) return;
    slip.normalize();
    contact.surface.mode |= dContactFDir1;
    for (int i = 0; i < 3; ++i) contact.fdir1[i] = slip[i];
  }

  OdeSetup setup_;
  double h_;
  Surface surface_;
  dWorldID world_ = nullptr;
  dSpaceID space_ = nullptr;
  dJointGroupID group_ = nullptr;
  std::vector<dBodyID> bodies_;
  std::vector<BodySample> still_;
};

EngineSetup row(const std::string& name, const std::string& why, const OdeSetup& setup,
                Meant meant = Meant::Always) {
  return {.engine = "ODE",
          .name = name,
          .why = why,
          .asItComes = name == "default",
          .meant = meant,
          .make = [setup](const Scene& scene, double h) {
            return std::make_unique<Ode>(scene, h, setup);
          }};
}

}  // namespace

std::vector<EngineSetup> odeSetups() {
  return {
      row("default", "dWorldStep as it comes", {}, Meant::FewMove),
      row("quick", "dWorldQuickStep as it comes, 20 sweeps", {.sweeps = 20}),
      row("quick, 100", "with 100 sweeps, for stacks", {.sweeps = 100}, Meant::ManyMove),
      row("hard", "no softness at all: rebounds keep their energy", {.cfm = 0.0}, Meant::OneMoves),
      row("soft 4", "softer, four contacts a pair: dWorldStep finds an answer more often",
          {.cfm = 1e-5, .contacts = 4}, Meant::FewMove),
      row("soft 8", "a little softer, for unlike masses", {.cfm = 1e-8}, Meant::FewMove),
      row("aligned", "soft 4 with friction along the slip, which is right in any direction",
          {.cfm = 1e-5, .contacts = 4, .aligned = true}, Meant::FewMove),
      row("finite", "rotations advance by finite angles", {.finite = true}, Meant::OneMoves),
  };
}

}  // namespace tumble::peers
