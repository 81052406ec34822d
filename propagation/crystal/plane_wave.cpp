#include "propagation/crystal/plane_wave.h"

#include <Eigen/Geometry>

namespace floe {

namespace {

using Complex = std::complex<double>;

// Without Eigen's conjugation of the left factor.
Complex plain_dot(const ComplexVec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

ComplexVec3 cross(const ComplexVec3& a, const ComplexVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

Fields fields_of(const ComplexVec3& k, const Vec3& axis, Polarisation polarisation,
                 const CrystalIndices& indices) {
  const double square = indices.ordinary * indices.ordinary;
  Vec3 c = axis;
  if (cross(k, c.cast<Complex>()).squaredNorm() < 1e-20) c = axis.unitOrthogonal();
  const bool ordinary = polarisation == Polarisation::ordinary;
  const ComplexVec3 E =
      ordinary ? cross(k, c.cast<Complex>()) : ComplexVec3(k * plain_dot(k, c) - square * c);
  const double norm = 1 / E.norm();
  return {norm * E, norm * cross(k, E)};
}

Vec3 extraordinary_product(const Vec3& v, const Vec3& axis, const CrystalIndices& indices) {
  const double ordinary = 1 / (indices.ordinary * indices.ordinary),
               extraordinary = 1 / (indices.extraordinary * indices.extraordinary);
  return extraordinary * v + (ordinary - extraordinary) * axis.dot(v) * axis;
}

Vec3 energy_direction(const Vec3& k, const Vec3& axis, Polarisation polarisation,
                      const CrystalIndices& indices) {
  if (polarisation == Polarisation::ordinary) return k.normalized();
  return extraordinary_product(k, axis, indices).normalized();
}

// Of an extraordinary wave, M k lies along the direction s: k ~ M^-1 s, and k.M k = 1 gives its length.
Vec3 wave_vector_of(const Vec3& direction, const Vec3& axis, Polarisation polarisation,
                    const CrystalIndices& indices) {
  const double o = indices.ordinary * indices.ordinary, e = indices.extraordinary * indices.extraordinary;
  if (polarisation == Polarisation::ordinary) return indices.ordinary * direction;
  const Vec3 wave = e * direction + (o - e) * axis.dot(direction) * axis;
  return wave / std::sqrt(direction.dot(wave));
}

// k = across + x normal. Of an extraordinary wave, k.M k = 1 is a quadratic equation for x; the energy flows
// along M k, so that normal.M k, plus or minus the root of its discriminant, tells the two waves apart.
Complex normal_component(const Vec3& across, const Vec3& normal, double side, const Vec3& axis,
                         Polarisation polarisation, const CrystalIndices& indices) {
  // The principal root of a negative number is +i|.|: it decays along the normal, and -i|.| against it.
  if (polarisation == Polarisation::ordinary)
    return side * std::sqrt(Complex(indices.ordinary * indices.ordinary - across.squaredNorm()));
  const Vec3 M_normal = extraordinary_product(normal, axis, indices);
  const double a = normal.dot(M_normal), b = across.dot(M_normal),
               c = across.dot(extraordinary_product(across, axis, indices)) - 1;
  return (-b + side * std::sqrt(Complex(b * b - a * c))) / a;
}

}  // namespace floe
