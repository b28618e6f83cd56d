#include <nmm/base/exceptions.h>
#include <nmm/materials/inelastic_law.h>
#include <nmm/materials/mohr_coulomb_law.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace NMM
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  namespace
  {
    using Vector3 = Tensor<1, 3>;
    using Matrix3 = Tensor<2, 3>;

    /// (1 + sin a) / (1 - sin a) of the angle a that is given by its tangent.
    double
    passive_coefficient(const double tangent)
    {
      const double sine = tangent / std::hypot(1., tangent);
      return (1. + sine) / (1. - sine);
    }


    /// A yield condition a . sigma <= k on sorted principal stresses, with plastic flow along b.
    struct YieldPlane
    {
      Vector3 normal, flow;
      double  limit;
    };


    /// In plane strain those that can be active where the principal stresses are sorted. In plane
    /// stress sigma_zz = 0 is the last one and may come anywhere in the order, also after a
    /// return from elsewhere, so that there is a plane for each order.
    std::vector<YieldPlane>
    yield_planes(const MohrCoulombLaw &law, const PlaneState plane_state)
    {
      const double N     = passive_coefficient(law.friction);
      const double M     = passive_coefficient(law.dilation);
      const double shear = 2. * law.cohesion * std::sqrt(N);
      const double tension =
        law.friction > 0. ? std::min(law.tensile_strength, shear / (N - 1.))
                          : law.tensile_strength;
      std::vector<YieldPlane> planes;
      constexpr unsigned int  orders[6][2] = {
         {0, 2}, {0, 1}, {1, 2}, {2, 0}, {1, 0}, {2, 1}};
      for (const auto &[large, small] : orders)
        if (large < small || plane_state == PlaneState::plane_stress)
        {
          planes.push_back({Vector3(), Vector3(), shear});
          planes.back().normal[large] = N;
          planes.back().flow[large]   = M;
          planes.back().normal[small] = planes.back().flow[small] = -1.;
        }
      for (unsigned int i = 0; i < 3; ++i)
      {
        Vector3 axis;
        axis[i] = 1.;
        planes.push_back({axis, axis, tension});
      }
      return planes;
    }


    /// The result of a step from its trial stress, in the principal axes of the trial stress.
    struct PrincipalReturn
    {
      bool is_elastic = true;
      /// Whether an admissible active set was found; if not, the rest is undefined.
      bool    has_stress = true;
      Vector3 stress;
      /// Increment of the plastic strain Delta epsilon^p [-].
      Vector3 flow;
      /// Derivative d sigma / d epsilon [Pa]; not set if the step is elastic.
      Matrix3 tangent;
    };


    /**
     * The implicit return to the yield surface in principal stresses. With the planes A sigma <= k
     * of an active set and their flows B, the multipliers are
     * @f[ \lambda = (A C B)^{-1}(A\sigma^\mathrm{trial} - k), \quad
     *     \sigma = \sigma^\mathrm{trial} - C B\lambda, \quad
     *     \frac{d\sigma}{d\varepsilon} = C - C B (A C B)^{-1} A C; @f]
     * The set is admissible if no multiplier is negative and the conditions of all planes hold.
     * In plane stress C is that of the plane, with zeros for the third axis: strain across the plane
     * follows freely and causes no stress.
     * All matrices depend on the law only and are computed once.
     */
    class PrincipalReturnMap
    {
    public:
      PrincipalReturnMap(const MohrCoulombLaw  &law,
                         const PlaneElasticity &elasticity,
                         PlaneState             plane_state);

      PrincipalReturn
      operator()(const Vector3 &trial) const;

    private:
      struct ActiveSet
      {
        std::vector<unsigned int> planes;
        /// Rows of (A C B)^-1 A, and (A C B)^-1 k. Multiplier i is by_trial[i] . trial -
        /// at_zero[i].
        std::vector<Vector3> by_trial;
        std::vector<double>  at_zero;
        Matrix3              tangent;
      };

      bool
      is_satisfied(const Vector3 &stress, double size) const;

      void
      add_set(std::vector<unsigned int> planes, const Matrix3 &C);

      std::vector<YieldPlane> planes;
      /// C b of each plane [Pa].
      std::vector<Vector3> stress_of_flow;
      /// Active sets in the order in which they are tried: one plane, two, and three.
      std::vector<ActiveSet> sets;
      double                 mu;
    };


    /// Relative rounding error that is allowed in a . sigma - k and in multipliers [-].
    constexpr double rounding = 1e-12;


    PrincipalReturnMap::PrincipalReturnMap(const MohrCoulombLaw  &law,
                                           const PlaneElasticity &elasticity,
                                           const PlaneState       plane_state)
      : planes(yield_planes(law, plane_state))
      , mu(elasticity.mu)
    {
      const unsigned int n_axes =
        plane_state == PlaneState::plane_stress ? 2 : 3;
      Matrix3 C;
      for (unsigned int i = 0; i < n_axes; ++i)
        for (unsigned int j = 0; j < n_axes; ++j)
          C[i][j] = elasticity.lambda + (i == j ? 2. * elasticity.mu : 0.);
      const unsigned int n = planes.size();
      for (unsigned int i = 0; i < n; ++i)
        stress_of_flow.push_back(C * planes[i].flow);
      for (unsigned int i = 0; i < n; ++i)
        add_set({i}, C);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = i + 1; j < n; ++j)
          add_set({i, j}, C);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = i + 1; j < n; ++j)
          for (unsigned int k = j + 1; k < n; ++k)
            add_set({i, j, k}, C);
    }


    /// Adds the set of the @p chosen planes, unless these do not determine the multipliers.
    void
    PrincipalReturnMap::add_set(std::vector<unsigned int> chosen,
                                const Matrix3            &C)
    {
      const unsigned int n = chosen.size();
      Eigen::MatrixXd    A(n, 3), G(n, n);
      Eigen::VectorXd    k(n);
      for (unsigned int i = 0; i < n; ++i)
      {
        k[i] = planes[chosen[i]].limit;
        for (unsigned int j = 0; j < 3; ++j)
          A(i, j) = planes[chosen[i]].normal[j];
        for (unsigned int j = 0; j < n; ++j)
          G(i, j) = planes[chosen[i]].normal * stress_of_flow[chosen[j]];
      }
      Eigen::FullPivLU<Eigen::MatrixXd> factors(G);
      factors.setThreshold(1e-10);
      if (!factors.isInvertible())
        return;
      const Eigen::MatrixXd by_trial = factors.solve(A);
      const Eigen::VectorXd at_zero  = factors.solve(k);
      ActiveSet             set{std::move(chosen), {}, {}, C};
      for (unsigned int i = 0; i < n; ++i)
      {
        set.by_trial.emplace_back(
          Vector3({by_trial(i, 0), by_trial(i, 1), by_trial(i, 2)}));
        set.at_zero.push_back(at_zero[i]);
        set.tangent -= dealii::outer_product(stress_of_flow[set.planes[i]],
                                             set.by_trial[i] * C);
      }
      sets.push_back(std::move(set));
    }


    bool
    PrincipalReturnMap::is_satisfied(const Vector3 &stress,
                                     const double   size) const
    {
      return std::all_of(planes.begin(),
                         planes.end(),
                         [&](const YieldPlane &plane) {
                           return plane.normal * stress - plane.limit <=
                                  rounding * (plane.normal.norm() * size +
                                              std::abs(plane.limit));
                         });
    }


    PrincipalReturn
    PrincipalReturnMap::operator()(const Vector3 &trial) const
    {
      PrincipalReturn result;
      result.stress     = trial;
      const double size = trial.norm();
      if (is_satisfied(trial, size))
        return result;

      result.is_elastic = false;
      for (const ActiveSet &set : sets)
      {
        result.stress   = trial;
        result.flow     = 0.;
        bool is_loading = true;
        for (unsigned int i = 0; i < set.planes.size() && is_loading; ++i)
        {
          const double multiplier = set.by_trial[i] * trial - set.at_zero[i];
          is_loading              = multiplier >= -rounding * size / mu;
          result.stress -= multiplier * stress_of_flow[set.planes[i]];
          result.flow += multiplier * planes[set.planes[i]].flow;
        }
        if (is_loading && is_satisfied(result.stress, size))
        {
          result.tangent = set.tangent;
          return result;
        }
      }
      result.has_stress = false;
      return result;
    }


    class MohrCoulomb : public InelasticLaw
    {
    public:
      MohrCoulomb(const MohrCoulombLaw &law,
                  const Material       &material,
                  const PlaneState      plane_state)
        : plane_state(plane_state)
        , elasticity(material.plane_elasticity(plane_state))
        , poissons_ratio(material.poissons_ratio)
        , return_map(law, elasticity, plane_state)
        , initial_stress(material.initial_stress)
        , initial_stress_zz(material.initial_stress_zz(plane_state))
      {
      }

      Deformation
      evaluate(const SymmetricTensor<2, 2> &strain,
               const MaterialState         &state,
               Response                    &response) const override;

    private:
      /// Sets the energy, the stress and the strain across the plane by Hooke's law for the
      /// plastic strain in @p response.
      void
      set_elastic(const SymmetricTensor<2, 2> &strain,
                  Response                    &response) const;

      PlaneState            plane_state;
      PlaneElasticity       elasticity;
      double                poissons_ratio;
      PrincipalReturnMap    return_map;
      SymmetricTensor<2, 2> initial_stress;
      double                initial_stress_zz;
    };


    /// In plane stress neither initial nor caused stress does work across the plane.
    void
    MohrCoulomb::set_elastic(const SymmetricTensor<2, 2> &strain,
                             Response                    &response) const
    {
      const SymmetricTensor<2, 2> e = strain - response.state.plastic_strain;
      const bool   is_thin          = plane_state == PlaneState::plane_stress;
      const double e_zz =
        is_thin ? -poissons_ratio / (1. - poissons_ratio) * dealii::trace(e)
                : -response.state.plastic_strain_zz;
      response.strain_zz =
        is_thin ? e_zz + response.state.plastic_strain_zz : 0.;

      const double pressure =
        elasticity.lambda * (dealii::trace(e) + (is_thin ? 0. : e_zz));
      SymmetricTensor<2, 2> caused = 2. * elasticity.mu * e;
      caused[0][0] += pressure;
      caused[1][1] += pressure;
      const double caused_zz =
        is_thin ? 0. : pressure + 2. * elasticity.mu * e_zz;
      response.energy = 0.5 * (caused * e + caused_zz * e_zz) +
                        initial_stress * e + initial_stress_zz * e_zz;
      response.stress    = initial_stress + caused;
      response.stress_zz = initial_stress_zz + caused_zz;
    }


    Deformation
    MohrCoulomb::evaluate(const SymmetricTensor<2, 2> &strain,
                          const MaterialState         &state,
                          Response                    &response) const
    {
      response.state = state;
      set_elastic(strain, response);
      response.dissipated = 0.;

      // The in-plane principal directions of the trial stress are p and q.
      const auto  &s      = response.stress;
      const double mean   = 0.5 * (s[0][0] + s[1][1]);
      const double half   = 0.5 * (s[0][0] - s[1][1]);
      const double radius = std::hypot(half, s[0][1]);
      const double angle  = 0.5 * std::atan2(s[0][1], half);
      const double cosine = std::cos(angle), sine = std::sin(angle);
      const std::array<double, 3> unsorted = {
        {mean + radius, mean - radius, response.stress_zz}};
      std::array<unsigned int, 3> order = {{0, 1, 2}};
      if (plane_state == PlaneState::plane_strain)
        std::stable_sort(order.begin(),
                         order.end(),
                         [&](const unsigned int i, const unsigned int j) {
                           return unsorted[i] > unsorted[j];
                         });
      Vector3 trial;
      for (unsigned int i = 0; i < 3; ++i)
        trial[i] = unsorted[order[i]];

      const PrincipalReturn sorted = return_map(trial);
      if (!sorted.has_stress)
        return Deformation::inverted;
      response.is_elastic = sorted.is_elastic;
      if (sorted.is_elastic)
        return Deformation::admissible;
      Vector3 stress, flow;
      Matrix3 D;
      for (unsigned int i = 0; i < 3; ++i)
      {
        stress[order[i]] = sorted.stress[i];
        flow[order[i]]   = sorted.flow[i];
        for (unsigned int j = 0; j < 3; ++j)
          D[order[i]][order[j]] = sorted.tangent[i][j];
      }

      const Tensor<1, 2> p({cosine, sine}), q({-sine, cosine});
      const auto         pp = dealii::symmetrize(dealii::outer_product(p, p));
      const auto         qq = dealii::symmetrize(dealii::outer_product(q, q));
      const auto pq = 2. * dealii::symmetrize(dealii::outer_product(p, q));
      response.state.plastic_strain += flow[0] * pp + flow[1] * qq;
      response.state.plastic_strain_zz += flow[2];
      const double volume = (flow[0] + flow[1] + flow[2]) / 3.;
      response.state.equivalent_plastic_strain +=
        std::sqrt(2. / 3. * (flow * flow - 3. * volume * volume));
      set_elastic(strain, response);
      // The stress is taken from the return map, since the difference of strains in set_elastic()
      // has cancellation errors.
      response.stress     = stress[0] * pp + stress[1] * qq;
      response.stress_zz  = stress[2];
      response.dissipated = stress * flow;

      // The principal directions rotate with the trial stress. The shear modulus is mu times the
      // ratio of the principal stress differences of the stress and the trial stress, or its limit
      // where the trial stress has no principal directions.
      const double shear_modulus =
        radius > 1e-8 * (std::abs(mean) + elasticity.mu * 1e-8)
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
      return Deformation::admissible;
    }
  } // namespace


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
    const bool is_thin = plane_state == PlaneState::plane_stress;
    check_law_value(cohesion > 0. || (friction > 0. && !is_thin),
                    "the cohesion",
                    cohesion,
                    where,
                    is_thin ? "give a positive one: friction alone bears "
                              "nothing in plane stress"
                            : "give a positive one, or a friction angle: a "
                              "material needs some strength");
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
  MohrCoulombLaw::inelastic_law(const Material  &material,
                                const PlaneState plane_state) const
  {
    return std::make_shared<MohrCoulomb>(*this, material, plane_state);
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
