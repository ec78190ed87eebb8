#include "sim/body/body_jet.h"

#include <cmath>

namespace tumble {
namespace {

/// Coefficient k of the Cauchy product of two series: Σ a_j · b_{k−j}.
template <class Result, class A, class B, class Product>
Result cauchy(const std::vector<A>& a, const std::vector<B>& b, int k, Product product) {
  Result sum = product(a[0], b[k]);
  for (int j = 1; j <= k; ++j) sum += product(a[j], b[k - j]);
  return sum;
}

Vec3 crossOf(const Vec3& a, const Vec3& b) {
  return a.cross(b);
}
double dotOf(const Vec3& a, const Vec3& b) {
  return a.dot(b);
}
double times(double a, double b) {
  return a * b;
}
Vec3 scaled(double a, const Vec3& b) {
  return a * b;
}
Vec3 toBodyFrame(const Mat3& R, const Vec3& v) {
  return R.transpose() * v;
}
Vec3 toWorldFrame(const Mat3& R, const Vec3& v) {
  return R * v;
}

/// q (0, w), components w first.
Vec4 quaternionTimes(const Vec4& q, const Vec3& w) {
  const Vec3 u = q.tail<3>();
  Vec4 product;
  product[0] = -u.dot(w);
  product.tail<3>() = q[0] * w + u.cross(w);
  return product;
}

/// Coefficient k of the rotation matrix; |q|² does not change along the motion.
Mat3 rotationCoefficient(const std::vector<Vec4>& q, int k) {
  Eigen::Matrix4d p = Eigen::Matrix4d::Zero();
  for (int j = 0; j <= k; ++j) p += q[j] * q[k - j].transpose();
  const double s = 2.0 / q[0].squaredNorm();
  Mat3 R;
  R << -(p(2, 2) + p(3, 3)), p(1, 2) - p(0, 3), p(1, 3) + p(0, 2),  //
      p(1, 2) + p(0, 3), -(p(1, 1) + p(3, 3)), p(2, 3) - p(0, 1),   //
      p(1, 3) - p(0, 2), p(2, 3) + p(0, 1), -(p(1, 1) + p(2, 2));
  R *= s;
  if (k == 0) R += Mat3::Identity();
  return R;
}

/// Coefficient k of aᵖ from those of a and the lower ones of b = aᵖ (Euler's recurrence).
double powerCoefficient(const std::vector<double>& a, double p, const std::vector<double>& b,
                        int k) {
  double sum = 0.0;
  for (int j = 0; j < k; ++j) sum += (p * (k - j) - j) * a[k - j] * b[j];
  return sum / (k * a[0]);
}

/// Calls act(index) for the one body of a force, or for each, fixed ones left out.
template <class Action>
void forEachFree(std::span<const RigidBody> bodies, int index, Action act) {
  const int first = index == kNoBody ? 0 : index;
  const int end = index == kNoBody ? static_cast<int>(bodies.size()) : index + 1;
  for (int i = first; i < end; ++i)
    if (!bodies[i].fixed()) act(i);
}

}  // namespace

bool BodyJet::covers(std::span<const Force> forces, std::span<const RigidBody> bodies,
                     std::span<const int> pivotOf) {
  const auto held = [&](int body) {
    bool any = false;
    forEachFree(bodies, body, [&](int i) { any = any || pivotOf[i] >= 0; });
    return any;
  };
  for (const Force& force : forces) {
    if (const LinearDrag* drag = std::get_if<LinearDrag>(&force)) {
      if (held(drag->body)) return false;
    } else if (const CircularField* field = std::get_if<CircularField>(&force)) {
      if (held(field->body)) return false;
    } else if (const Spring* spring = std::get_if<Spring>(&force)) {
      if (held(spring->a) || (spring->b != kNoBody && held(spring->b))) return false;
    } else if (!std::holds_alternative<UniformWind>(force) &&
               !std::holds_alternative<PointForce>(force)) {
      return false;
    }
  }
  return true;
}

void BodyJet::expand(const Vec3& gravity, std::span<const Force> forces,
                     std::span<const Pivot> pivots, std::span<const int> pivotOf,
                     std::span<const RigidBody> bodies, int order) {
  gravity_ = gravity;
  forces_ = forces;
  pivots_ = pivots;
  pivotOf_ = pivotOf;
  bodies_ = bodies;
  begin(order);
  for (int k = 0; k <= order; ++k) {
    move(k);
    addForces(k);
    addMomenta(k);
  }
}

/// Room for all coefficients, and those of order 0.
void BodyJet::begin(int order) {
  const std::size_t room = static_cast<std::size_t>(order) + 2;
  series_.resize(bodies_.size());
  springs_.resize(forces_.size());
  power_.assign(room, 0.0);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const RigidBody& body = bodies_[i];
    BodySeries& s = series_[i];
    for (std::vector<Vec3>* v :
         {&s.x, &s.P, &s.L, &s.spin_B, &s.own_B, &s.omega_B, &s.force, &s.torque_B})
      v->assign(room, Vec3::Zero());
    s.q.assign(room, Vec4::Zero());
    s.R.assign(room, Mat3::Zero());
    s.x[0] = body.x;
    s.q[0] << body.q.w(), body.q.vec();
    s.R[0] = body.R;
    s.P[0] = body.P;
    s.L[0] = body.L;
    s.gripped = held(static_cast<int>(i));
    if (!body.particle && !body.fixed())
      s.spin_B[0] =
          body.R.transpose() * (s.gripped ? momentumAbout(pivots_[pivotOf_[i]], body) : body.L);
  }
  markGripped();
  for (SpringSeries& s : springs_) {
    for (std::vector<Vec3>* v : {&s.span, &s.force}) v->assign(room, Vec3::Zero());
    for (std::vector<double>* v : {&s.length2, &s.inverse, &s.pull, &s.rate}) v->assign(room, 0.0);
  }
}

void BodyJet::markGripped() {
  const auto mark = [&](int body) {
    if (body != kNoBody) series_[body].gripped = true;
  };
  for (const Force& force : forces_) {
    if (const PointForce* point = std::get_if<PointForce>(&force)) mark(point->body);
    if (const LinearDrag* drag = std::get_if<LinearDrag>(&force))
      forEachFree(bodies_, drag->body, mark);
    if (const Spring* spring = std::get_if<Spring>(&force)) mark(spring->a), mark(spring->b);
  }
}

/// Positions of order k + 1 from momenta of order k.
void BodyJet::move(int k) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const RigidBody& body = bodies_[i];
    BodySeries& s = series_[i];
    const double share = 1.0 / (k + 1);
    if (body.fixed()) {
      // Steady: ω is constant in the world, and so it is in the body.
      if (k == 0) s.x[1] = body.v;
      if (k == 0) s.omega_B[0] = body.R.transpose() * body.omega;
    } else if (!held(static_cast<int>(i))) {
      s.x[k + 1] = share * body.invM * s.P[k];
      s.omega_B[k] = body.IbodyInv * s.spin_B[k];
    } else {
      s.omega_B[k] = pivots_[pivotOf_[i]].IbodyInv * s.spin_B[k];
      s.own_B[k] = body.Ibody * s.omega_B[k];
    }
    if (body.particle) continue;
    s.q[k + 1] = 0.5 * share * cauchy<Vec4>(s.q, s.omega_B, k, quaternionTimes);
    if (s.gripped) s.R[k + 1] = rotationCoefficient(s.q, k + 1);
    if (!held(static_cast<int>(i))) continue;
    s.x[k + 1] = -(s.R[k + 1] * pivots_[pivotOf_[i]].c_B);
    s.P[k] = body.M * (k + 1) * s.x[k + 1];
  }
}

/// Coefficient k of a body point in the world.
Vec3 BodyJet::pointAt(int body, const Vec3& point_B, int k) const {
  return series_[body].x[k] + series_[body].R[k] * point_B;
}

/// A force, constant in the world, that grips a point of a body.
void BodyJet::grip(int body, const Vec3& point_B, const Vec3& force, int k) {
  BodySeries& s = series_[body];
  if (k == 0) s.force[0] += force;
  if (!s.gripped) return;
  const Vec3 arm = held(body) ? Vec3(point_B - pivots_[pivotOf_[body]].c_B) : point_B;
  s.torque_B[k] += arm.cross(s.R[k].transpose() * force);
}

/// A force, given by its series, that grips a point of a body.
void BodyJet::grip(int body, const Vec3& point_B, const std::vector<Vec3>& force, double sign,
                   int k) {
  BodySeries& s = series_[body];
  s.force[k] += sign * force[k];
  s.torque_B[k] += sign * point_B.cross(cauchy<Vec3>(s.R, force, k, toBodyFrame));
}

void BodyJet::addForces(int k) {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (!bodies_[i].fixed())
      grip(static_cast<int>(i), Vec3::Zero(), Vec3(bodies_[i].M * gravity_), k);
  for (std::size_t n = 0; n < forces_.size(); ++n) {
    if (const UniformWind* wind = std::get_if<UniformWind>(&forces_[n])) {
      forEachFree(bodies_, wind->body, [&](int i) {
        grip(i, Vec3::Zero(), wind->force, k);
        power_[k] += (k + 1) * wind->force.dot(series_[i].x[k + 1]);
      });
    } else if (const PointForce* point = std::get_if<PointForce>(&forces_[n])) {
      forEachFree(bodies_, point->body, [&](int i) {
        grip(i, point->point_B, point->force, k);
        power_[k] += (k + 1) * point->force.dot(pointAt(i, point->point_B, k + 1));
      });
    } else if (const LinearDrag* drag = std::get_if<LinearDrag>(&forces_[n])) {
      forEachFree(bodies_, drag->body, [&](int i) {
        BodySeries& s = series_[i];
        const double perMomentum = drag->linear * bodies_[i].invM;
        s.force[k] -= perMomentum * s.P[k];
        s.torque_B[k] -= drag->angular * s.omega_B[k];
        power_[k] -= perMomentum * bodies_[i].invM * cauchy<double>(s.P, s.P, k, dotOf) +
                     drag->angular * cauchy<double>(s.omega_B, s.omega_B, k, dotOf);
      });
    } else if (const CircularField* field = std::get_if<CircularField>(&forces_[n])) {
      // Linear in x − c: coefficient by coefficient.
      forEachFree(bodies_, field->body, [&](int i) {
        const Vec3 x = k == 0 ? Vec3(series_[i].x[0] - field->centre) : series_[i].x[k];
        series_[i].force[k] += bodies_[i].M * field->rotation.cross(field->rotation.cross(x));
      });
    } else if (const Spring* spring = std::get_if<Spring>(&forces_[n])) {
      addSpring(*spring, springs_[n], k);
    }
  }
}

/// f = −pull · span,  pull = stiffness (1 − rest/l) + damping (span·ṡpan)/l².
void BodyJet::addSpring(const Spring& spring, SpringSeries& s, int k) {
  const auto spanAt = [&](int n) -> Vec3 {
    const Vec3 a = pointAt(spring.a, spring.anchorA_B, n);
    if (spring.b != kNoBody) return a - pointAt(spring.b, spring.anchorB_B, n);
    return n == 0 ? Vec3(a - spring.anchorB_B) : a;
  };
  if (k == 0) {
    s.span[0] = spanAt(0);
    s.length2[0] = s.span[0].squaredNorm();
  }
  s.span[k + 1] = spanAt(k + 1);
  s.length2[k + 1] = cauchy<double>(s.span, s.span, k + 1, dotOf);
  if (s.length2[0] == 0.0) return;  // without a direction it pulls at nothing

  s.inverse[k] =
      k == 0 ? 1.0 / std::sqrt(s.length2[0]) : powerCoefficient(s.length2, -0.5, s.inverse, k);
  // l̇ = ½ (l²)˙ / l, and l̇/l is what the damper pulls by.
  s.rate[k] = 0.0;
  for (int j = 0; j <= k; ++j) s.rate[k] += 0.5 * (j + 1) * s.length2[j + 1] * s.inverse[k - j];
  s.pull[k] = spring.damping * cauchy<double>(s.rate, s.inverse, k, times) -
              spring.stiffness * spring.rest * s.inverse[k] + (k == 0 ? spring.stiffness : 0.0);
  s.force[k] = -cauchy<Vec3>(s.pull, s.span, k, scaled);
  power_[k] -= spring.damping * cauchy<double>(s.rate, s.rate, k, times);

  // An end that is led along gives what its bearer pushes.
  const auto end = [&](int body, const Vec3& anchor_B, double sign) {
    if (body == kNoBody) return;
    if (!bodies_[body].fixed()) return grip(body, anchor_B, s.force, sign, k);
    for (int j = 0; j <= k; ++j)
      power_[k] -= sign * (j + 1) * pointAt(body, anchor_B, j + 1).dot(s.force[k - j]);
  };
  end(spring.a, spring.anchorA_B, 1.0);
  end(spring.b, spring.anchorB_B, -1.0);
}

/// Momenta of order k + 1 from forces of order k.
void BodyJet::addMomenta(int k) {
  const double share = 1.0 / (k + 1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const RigidBody& body = bodies_[i];
    BodySeries& s = series_[i];
    if (body.fixed()) continue;
    if (!held(static_cast<int>(i))) s.P[k + 1] = share * s.force[k];
    if (body.particle) continue;
    s.spin_B[k + 1] = share * (cauchy<Vec3>(s.spin_B, s.omega_B, k, crossOf) + s.torque_B[k]);
    if (held(static_cast<int>(i))) {
      if (k > 0) s.L[k] = cauchy<Vec3>(s.R, s.own_B, k, toWorldFrame);
    } else if (s.gripped) {
      s.L[k + 1] = share * cauchy<Vec3>(s.R, s.torque_B, k, toWorldFrame);
    }
  }
}

}  // namespace tumble
