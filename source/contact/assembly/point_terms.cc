#include <algorithm>
#include <cmath>
#include <contact/assembly/point_terms.h>

namespace NMM
{
  namespace internal
  {
    ContactKinematics::ContactKinematics(
      const ContactSurface::WeightValues &slave,
      const ContactSurface::Weights      &master,
      const ContactSurface::Place        &place,
      const double                        gap,
      const bool                          with_friction)
      : n_slave(slave.n)
      , n_master(master.n)
      , n(2 * (slave.n + master.n))
      , normal(place.normal())
      , tangent(place.a / place.a.norm())
      , gap(gap)
      , length(place.a.norm())
      , bending(place.b * normal)
      , h(length * length - gap * bending)
    {
      for (unsigned int i = 0; i < n_slave; ++i)
        for (unsigned int c = 0; c < 2; ++c)
        {
          const unsigned int k = unknown_of(i, c);
          N[k]                 = slave.w[i] * normal[c];
          T[k]                 = slave.w[i] * tangent[c];
          N1[k] = T1[k] = 0.;
          D[k]          = length * T[k] / h;
        }
      for (unsigned int i = 0; i < n_master; ++i)
        for (unsigned int c = 0; c < 2; ++c)
        {
          const unsigned int k = 2 * (n_slave + i) + c;
          N[k]                 = -master.w[i] * normal[c];
          T[k]                 = -master.w[i] * tangent[c];
          N1[k]                = -master.dw[i] * normal[c];
          T1[k]                = -master.dw[i] * tangent[c];
          D[k]                 = (length * T[k] - gap * N1[k]) / h;
        }
      if (with_friction)
        for (unsigned int k = 0; k < n; ++k)
          C[k] = (bending * D[k] - N1[k]) / length;
    }


    void
    ContactKinematics::freeze()
    {
      for (double *const values : {N1, D, T1, C})
        std::fill_n(values, n, 0.);
    }


    namespace
    {
      /// Add @p factor times the derivative of the tangential distance from the anchor to @p row.
      void
      add_distance(const ContactKinematics            &f,
                   const ContactTraction              &traction,
                   const ContactSurface::WeightValues &slave,
                   const ContactSurface::WeightValues &stick,
                   const double                        factor,
                   double                             *row)
      {
        for (unsigned int k = 0; k < f.n; ++k)
          row[k] += factor * traction.normal_distance * f.C[k];
        for (unsigned int i = 0; i < slave.n; ++i)
          for (unsigned int c = 0; c < 2; ++c)
            row[unknown_of(i, c)] += factor * slave.w[i] * f.tangent[c];
        for (unsigned int i = 0; i < stick.n; ++i)
          for (unsigned int c = 0; c < 2; ++c)
            row[f.n + unknown_of(i, c)] -= factor * stick.w[i] * f.tangent[c];
      }
    } // namespace


    void
    add_contact_point(const ContactKinematics            &f,
                      const ContactTraction              &traction,
                      const ContactSurface::WeightValues *slave,
                      const ContactSurface::WeightValues *stick,
                      const bool                          with_tangent,
                      ContactLocalSystem                 &local)
    {
      const double       p = traction.pressure, q = traction.shear;
      const unsigned int stride          = 2 * local.n_covers;
      const auto         pressure_change = [&](const unsigned int k) {
        return traction.pressure_change != nullptr
                         ? traction.pressure_change[k]
                         : -traction.normal_stiffness * f.N[k];
      };
      for (unsigned int k = 0; k < f.n; ++k)
        local.rhs[k] += q * f.T[k] - p * f.N[k];
      if (!with_tangent)
        return;

      const double squared = f.length * f.length;
      const double mixed   = p * f.h / squared;
      const double first   = p * f.gap / squared;
      const double second  = p * f.h * f.bending / squared;
      for (unsigned int k = 0; k < f.n; ++k)
      {
        double      *row = local.matrix + k * stride;
        const double d_k = second * f.D[k] - mixed * f.N1[k];
        const double m_k = -mixed * f.D[k] - first * f.N1[k];
        for (unsigned int l = 0; l < f.n; ++l)
          row[l] += d_k * f.D[l] + m_k * f.N1[l] - f.N[k] * pressure_change(l);
      }
      if (stick == nullptr)
        return;

      // Change of the shear, and of the part of the pressure that depends on the slip.
      double       change[ContactKinematics::max] = {};
      const double by_slip                        = traction.pressure_by_slip;
      const double by_distance =
        traction.shear_stiffness + traction.shear_over_pressure * by_slip;
      if (by_distance != 0.)
        add_distance(f, traction, *slave, *stick, by_distance, change);
      if (traction.shear_by_half_slip != 0.)
        for (unsigned int k = 0; k < f.n; ++k)
          change[k] +=
            traction.shear_by_half_slip * traction.half_slip_change[k];
      if (traction.shear_over_pressure != 0.)
        for (unsigned int k = 0; k < f.n; ++k)
          change[k] += traction.shear_over_pressure * pressure_change(k);
      if (by_slip != 0.)
      {
        double rise[ContactKinematics::max] = {};
        add_distance(f, traction, *slave, *stick, by_slip, rise);
        for (unsigned int k = 0; k < f.n; ++k)
          for (unsigned int l = 0; l < stride; ++l)
            local.matrix[k * stride + l] -= f.N[k] * rise[l];
      }
      for (unsigned int k = 0; k < f.n; ++k)
      {
        double *row = local.matrix + k * stride;
        for (unsigned int l = 0; l < stride; ++l)
          row[l] += f.T[k] * change[l];
        for (unsigned int l = 0; l < f.n; ++l)
          row[l] += q * (f.N[k] * f.C[l] + f.T1[k] * f.D[l]);
      }
    }
  } // namespace internal
} // namespace NMM
