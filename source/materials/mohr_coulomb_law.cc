#include <nmm/base/exceptions.h>
#include <nmm/materials/inelastic_law.h>
#include <nmm/materials/mohr_coulomb_law.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace NMM
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  namespace
  {
    using Vector3 = Tensor<1, 3>;
    using Matrix3 = Tensor<2, 3>;

    /// (1 + sin a) / (1 - sin a) of an angle given by its tangent.
    double
    passive_coefficient(const double tangent)
    {
      const double sine = tangent / std::hypot(1., tangent);
      return (1. + sine) / (1. - sine);
    }


    Matrix3
    elastic_moduli(const PlaneElasticity &elasticity)
    {
      Matrix3 C;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          C[i][j] = elasticity.lambda + (i == j ? 2. * elasticity.mu : 0.);
      return C;
    }


    /// Strains of principal stresses.
    Vector3
    elastic_strain(const PlaneElasticity &elasticity, const Vector3 &stress)
    {
      const double bulk = 3. * elasticity.lambda + 2. * elasticity.mu;
      const double sum  = stress[0] + stress[1] + stress[2];
      Vector3      strain;
      for (unsigned int i = 0; i < 3; ++i)
        strain[i] =
          (stress[i] - elasticity.lambda * sum / bulk) / (2. * elasticity.mu);
      return strain;
    }


    /// A condition a . sigma <= k on sorted principal stresses, with the flow along b.
    struct YieldPlane
    {
      Vector3 normal, flow;
      double  limit;
    };


    std::array<YieldPlane, 6>
    yield_planes(const MohrCoulombLaw &law)
    {
      const double N     = passive_coefficient(law.friction);
      const double M     = passive_coefficient(law.dilation);
      const double shear = 2. * law.cohesion * std::sqrt(N);
      const double tension =
        law.friction > 0. ? std::min(law.tensile_strength, shear / (N - 1.))
                          : law.tensile_strength;
      return {{{Vector3({N, 0., -1.}), Vector3({M, 0., -1.}), shear},
               {Vector3({N, -1., 0.}), Vector3({M, -1., 0.}), shear},
               {Vector3({0., N, -1.}), Vector3({0., M, -1.}), shear},
               {Vector3({1., 0., 0.}), Vector3({1., 0., 0.}), tension},
               {Vector3({0., 1., 0.}), Vector3({0., 1., 0.}), tension},
               {Vector3({0., 0., 1.}), Vector3({0., 0., 1.}), tension}}};
    }


    /// Solve G x = b of size @p n <= 3 by Gaussian elimination with pivots; false if G is
    /// singular to rounding.
    bool
    solve(const unsigned int n, double (&G)[3][3], double (&b)[3][4])
    {
      double largest = 0.;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          largest = std::max(largest, std::abs(G[i][j]));
      for (unsigned int k = 0; k < n; ++k)
      {
        unsigned int pivot = k;
        for (unsigned int i = k + 1; i < n; ++i)
          if (std::abs(G[i][k]) > std::abs(G[pivot][k]))
            pivot = i;
        if (!(std::abs(G[pivot][k]) > 1e-10 * largest))
          return false;
        std::swap_ranges(G[k], G[k] + 3, G[pivot]);
        std::swap_ranges(b[k], b[k] + 4, b[pivot]);
        for (unsigned int i = 0; i < n; ++i)
          if (i != k)
          {
            const double factor = G[i][k] / G[k][k];
            for (unsigned int j = k; j < n; ++j)
              G[i][j] -= factor * G[k][j];
            for (unsigned int j = 0; j < 4; ++j)
              b[i][j] -= factor * b[k][j];
          }
      }
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int j = 0; j < 4; ++j)
          b[k][j] /= G[k][k];
      return true;
    }


    /// Sets of planes that can be active together: one, two, three. The plane of shear between
    /// the largest and the smallest stress comes first, edges with it next.
    constexpr unsigned int                                no_plane    = 6;
    constexpr std::array<std::array<unsigned int, 3>, 18> active_sets = {
      {{{0, no_plane, no_plane}},
       {{3, no_plane, no_plane}},
       {{0, 1, no_plane}},
       {{0, 2, no_plane}},
       {{0, 3, no_plane}},
       {{3, 4, no_plane}},
       {{1, 3, no_plane}},
       {{2, 3, no_plane}},
       {{2, 4, no_plane}},
       {{0, 1, 3}},
       {{0, 2, 3}},
       {{0, 2, 4}},
       {{0, 3, 4}},
       {{2, 3, 4}},
       {{3, 4, 5}},
       {{0, 1, 2}},
       {{0, 1, 4}},
       {{1, 2, 3}}}};


    class MohrCoulomb : public InelasticLaw
    {
    public:
      MohrCoulomb(const MohrCoulombLaw &law, const Material &material)
        : law(law)
        , elasticity(material.plane_elasticity(PlaneState::plane_strain))
        , initial_stress(material.initial_stress)
        , initial_stress_zz(
            material.initial_stress_zz(PlaneState::plane_strain))
      {
      }

      void
      evaluate(const SymmetricTensor<2, 2> &strain,
               const MaterialState         &state,
               Response                    &response) const override;

    private:
      /// Fill in moduli and stress of Hooke's law.
      void
      set_elastic(const SymmetricTensor<2, 2> &elastic_strain,
                  double                       elastic_strain_zz,
                  Response                    &response) const;

      MohrCoulombLaw        law;
      PlaneElasticity       elasticity;
      SymmetricTensor<2, 2> initial_stress;
      double                initial_stress_zz;
    };


    void
    MohrCoulomb::set_elastic(const SymmetricTensor<2, 2> &e,
                             const double                 e_zz,
                             Response                    &response) const
    {
      const double pressure = elasticity.lambda * (dealii::trace(e) + e_zz);
      SymmetricTensor<2, 2> caused = 2. * elasticity.mu * e;
      caused[0][0] += pressure;
      caused[1][1] += pressure;
      const double caused_zz = pressure + 2. * elasticity.mu * e_zz;
      response.energy        = 0.5 * (caused * e + caused_zz * e_zz) +
                        initial_stress * e + initial_stress_zz * e_zz;
      response.stress    = initial_stress + caused;
      response.stress_zz = initial_stress_zz + caused_zz;
    }


    void
    MohrCoulomb::evaluate(const SymmetricTensor<2, 2> &strain,
                          const MaterialState         &state,
                          Response                    &response) const
    {
      const SymmetricTensor<2, 2> e    = strain - state.plastic_strain;
      const double                e_zz = -state.plastic_strain_zz;
      set_elastic(e, e_zz, response);
      response.state      = state;
      response.dissipated = 0.;

      // principal directions of the trial stress: p and q in the plane
      const auto  &s      = response.stress;
      const double mean   = 0.5 * (s[0][0] + s[1][1]);
      const double half   = 0.5 * (s[0][0] - s[1][1]);
      const double radius = std::hypot(half, s[0][1]);
      const double angle  = 0.5 * std::atan2(s[0][1], half);
      const double cosine = std::cos(angle), sine = std::sin(angle);
      const std::array<double, 3> unsorted = {
        {mean + radius, mean - radius, response.stress_zz}};
      std::array<unsigned int, 3> order = {{0, 1, 2}};
      std::stable_sort(order.begin(),
                       order.end(),
                       [&](const unsigned int i, const unsigned int j) {
                         return unsorted[i] > unsorted[j];
                       });
      Vector3 trial;
      for (unsigned int i = 0; i < 3; ++i)
        trial[i] = unsorted[order[i]];

      const internal::PrincipalReturn sorted =
        internal::return_to_mohr_coulomb(law, elasticity, trial);
      response.is_elastic = sorted.is_elastic;
      Vector3 stress, flow;
      Matrix3 D;
      for (unsigned int i = 0; i < 3; ++i)
      {
        stress[order[i]] = sorted.stress[i];
        flow[order[i]]   = sorted.plastic_strain[i];
        for (unsigned int j = 0; j < 3; ++j)
          D[order[i]][order[j]] = sorted.tangent[i][j];
      }

      const Tensor<1, 2> p({cosine, sine}), q({-sine, cosine});
      const auto         pp = dealii::symmetrize(dealii::outer_product(p, p));
      const auto         qq = dealii::symmetrize(dealii::outer_product(q, q));
      const auto pq = 2. * dealii::symmetrize(dealii::outer_product(p, q));
      if (!sorted.is_elastic)
      {
        const SymmetricTensor<2, 2> increment = flow[0] * pp + flow[1] * qq;
        response.state.plastic_strain += increment;
        response.state.plastic_strain_zz += flow[2];
        const double volume = (flow[0] + flow[1] + flow[2]) / 3.;
        double       square = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          square += (flow[i] - volume) * (flow[i] - volume);
        response.state.equivalent_plastic_strain += std::sqrt(2. / 3. * square);
        set_elastic(strain - response.state.plastic_strain,
                    -response.state.plastic_strain_zz,
                    response);
        // what was returned to, without what the difference of strains has lost
        response.stress     = stress[0] * pp + stress[1] * qq;
        response.stress_zz  = stress[2];
        response.dissipated = stress * flow;
      }

      // principal directions turn with the trial stress: by the ratio of differences, or its
      // limit where the trial stress has no directions
      const double shear_modulus =
        sorted.is_elastic ? elasticity.mu
        : radius > 1e-8 * (std::abs(mean) + elasticity.mu * 1e-8)
          ? elasticity.mu * (stress[0] - stress[1]) / (2. * radius)
          : 0.25 * (D[0][0] - D[0][1] - D[1][0] + D[1][1]);
      const SymmetricTensor<2, 2> *basis[2] = {&pp, &qq};
      for (unsigned int ij = 0; ij < 4; ++ij)
        for (unsigned int kl = 0; kl < 4; ++kl)
        {
          const unsigned int i = ij / 2, j = ij % 2, k = kl / 2, l = kl % 2;
          double             sum = shear_modulus * pq[i][j] * pq[k][l];
          for (unsigned int a = 0; a < 2; ++a)
            for (unsigned int b = 0; b < 2; ++b)
              sum += D[a][b] * (*basis[a])[i][j] * (*basis[b])[k][l];
          response.tangent[ij][kl] = sum;
        }
    }
  } // namespace


  namespace internal
  {
    PrincipalReturn
    return_to_mohr_coulomb(const MohrCoulombLaw  &law,
                           const PlaneElasticity &elasticity,
                           const Vector3         &trial)
    {
      PrincipalReturn result;
      const Matrix3   C      = elastic_moduli(elasticity);
      const auto      planes = yield_planes(law);
      result.stress          = trial;
      result.tangent         = C;

      const auto size = [&](const YieldPlane &plane) {
        return plane.normal.norm() * trial.norm() + std::abs(plane.limit);
      };
      // rounding of a . sigma - k
      constexpr double rounding     = 1e-12;
      const auto       is_satisfied = [&](const Vector3 &stress) {
        return std::all_of(planes.begin(),
                           planes.end(),
                           [&](const YieldPlane &plane) {
                             return plane.normal * stress - plane.limit <=
                                    rounding * size(plane);
                           });
      };
      if (is_satisfied(trial))
        return result;
      result.is_elastic = false;

      for (const auto &set : active_sets)
      {
        const unsigned int n =
          std::count_if(set.begin(), set.end(), [](const unsigned int plane) {
            return plane != no_plane;
          });
        // multipliers = G^-1 (a . trial - k) and their derivatives G^-1 a C by strain
        double G[3][3] = {}, multipliers[3][4] = {};
        for (unsigned int i = 0; i < n; ++i)
        {
          const YieldPlane &plane = planes[set[i]];
          const Vector3     aC    = plane.normal * C;
          multipliers[i][0]       = plane.normal * trial - plane.limit;
          for (unsigned int j = 0; j < 3; ++j)
            multipliers[i][1 + j] = aC[j];
          for (unsigned int j = 0; j < n; ++j)
            G[i][j] = aC * planes[set[j]].flow;
        }
        if (!solve(n, G, multipliers))
          continue;
        const double least = -rounding * trial.norm() / elasticity.mu;
        if (std::any_of(multipliers,
                        multipliers + n,
                        [&](const double(&row)[4]) { return row[0] < least; }))
          continue;
        Vector3 flow;
        Matrix3 tangent = C;
        for (unsigned int i = 0; i < n; ++i)
        {
          const Vector3 Cb = C * planes[set[i]].flow;
          flow += multipliers[i][0] * planes[set[i]].flow;
          for (unsigned int k = 0; k < 3; ++k)
            for (unsigned int l = 0; l < 3; ++l)
              tangent[k][l] -= Cb[k] * multipliers[i][1 + l];
        }
        const Vector3 stress = trial - C * flow;
        if (!is_satisfied(stress))
          continue;
        result.stress         = stress;
        result.plastic_strain = flow;
        result.tangent        = tangent;
        return result;
      }

      // Rounding can leave no set; the apex always holds.
      for (unsigned int i = 0; i < 3; ++i)
        result.stress[i] = planes[3].limit;
      result.plastic_strain = elastic_strain(elasticity, trial - result.stress);
      result.tangent        = 0.;
      return result;
    }
  } // namespace internal


  std::vector<MohrCoulombLaw::Parameter>
  MohrCoulombLaw::parameters()
  {
    return {{"Friction angle",
             &friction,
             Parameter::Kind::tangent,
             "Mohr-Coulomb: phi [degrees].",
             "give an angle from 0 to 89 degrees"},
            {"Cohesion",
             &cohesion,
             Parameter::Kind::number,
             "Mohr-Coulomb: c [Pa].",
             "give a stress of at least 0"},
            {"Tensile strength",
             &tensile_strength,
             Parameter::Kind::number,
             "Mohr-Coulomb: cut-off of tension [Pa]; no effect above "
             "c / tan(phi).",
             "give a stress of at least 0"},
            {"Dilation angle",
             &dilation,
             Parameter::Kind::tangent,
             "Mohr-Coulomb: psi, of the plastic flow [degrees].",
             "give an angle from 0 to the friction angle"}};
  }


  void
  MohrCoulombLaw::check(const std::string &where,
                        const PlaneState   plane_state) const
  {
    AssertThrow(plane_state == PlaneState::plane_strain,
                InputError("the law Mohr-Coulomb is for plane strain only",
                           where,
                           "set 'Model/Plane state = plane strain', or choose "
                           "another law"));
    check_law_value(friction >= 0. && std::isfinite(friction),
                    "tan(phi) of the friction angle",
                    friction,
                    where,
                    "give an angle from 0 to 89 degrees");
    check_law_value(cohesion >= 0. && std::isfinite(cohesion),
                    "the cohesion",
                    cohesion,
                    where,
                    "give a stress of at least 0");
    check_law_value(cohesion > 0. || friction > 0.,
                    "the cohesion",
                    cohesion,
                    where,
                    "give a positive one, or a friction angle: a material "
                    "needs some strength");
    check_law_value(tensile_strength >= 0. && std::isfinite(tensile_strength),
                    "the tensile strength",
                    tensile_strength,
                    where,
                    "give a stress of at least 0");
    check_law_value(dilation >= 0. && dilation <= friction,
                    "tan(psi) of the dilation angle",
                    dilation,
                    where,
                    "give an angle from 0 to the friction angle");
  }


  std::shared_ptr<const InelasticLaw>
  MohrCoulombLaw::inelastic_law(const Material &material,
                                const PlaneState) const
  {
    return std::make_shared<MohrCoulomb>(*this, material);
  }


  void
  MohrCoulombLaw::reduce_strength(const double factor)
  {
    friction /= factor;
    cohesion /= factor;
    tensile_strength /= factor;
    dilation /= factor;
  }
} // namespace NMM
