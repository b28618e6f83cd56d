#ifndef nmm_contact_state_carried_history_h
#define nmm_contact_state_carried_history_h

#include <nmm/contact/state/history.h>
#include <nmm/contact/surface/surface.h>

#include <vector>

namespace NMM
{
  /**
   * Carry the history of contact from the surface of a solid to the surface of the same solid after
   * it has been cut anew, with longer cracks or on another mesh. Contact::restore_history() of the
   * new Contact object takes the result over; the next detect() has to be at the same displacements
   * as a function of the reference position.
   *
   * All faces of @p from persist in @p to as sets of points in the reference configuration, but they
   * may be divided into edges differently. Let X be a place on the boundary, s its parameter on an
   * edge of @p from and s' that on an edge of @p to. Both edges run in the direction in which the
   * body is on the left, so that s' is an increasing affine function of s on each *common piece* of
   * both edges. A piece is common if the edges lie on the same line or circle and look the same way,
   * with a tolerance of 1e-9 times their lengths. The two faces of a joint have opposite normals and
   * are thus distinguished.
   *
   * **Anchors, bonds and slip.** The history along an edge is a function of s: the anchor (m, t), the
   * bond and the slip, interpolated between the points of the last accepted state. It is linear
   * between places at which the edge m or the bond changes. If s and t are replaced by s' and t',
   * it stays so, with further divisions where the new edges of the master end. So two places for
   * each interval between divisions represent it exactly; intervals shorter than 1e-6 of the piece
   * are left out. On both sides of a division at which the function jumps, places lie inside of
   * their interval by a thousandth of its length. An anchor beyond a smooth end of its
   * edge is a place of the next edge if its edge has been divided, else it stays on its edge.
   *
   * A corner that sticks keeps its history if its edge still ends there. Where a new crack divides
   * a master, its two new corners get the place of the slave that is stuck to them.
   *
   * Which of two edges is the slave may change, because blocks are numbered anew, and because a crack
   * that divides a block makes its faces those of two blocks. @p slave_priority is that of the new
   * ContactParameters and decides about it. Where the roles change, the map from s to t is
   * inverted: a place t of the old master is stuck to the place s of the old slave.
   * Edges of the new slave that no anchor of the old one lay on get no history, although contact
   * may reach onto them by the elastic slip.
   *
   * If an edge and the edges of all its anchors are the same in both surfaces to the last bit, its
   * places are copied. A surface that is the same therefore gets back the same history, except for
   * the last search.
   *
   * **Entrances and touching faces.** An entrance edge that has been divided is replaced by its
   * piece at the corner's anchor, or else by the piece nearest to the corner in the reference
   * configuration. Faces that touch each other are replaced by all of their pieces.
   *
   * **Energies of springs.** ContactTimeStep::begin() scales down springs that store more than their
   * pair of bodies did before, and counts what is missing as dissipated. If a crack has divided a
   * body, the history does not tell how much of the energy belongs to which part. Without an energy
   * a pair would lose all its forces, and with a wrong one a part of them. Therefore only the sum
   * over the parts is kept: ContactHistory::former_bodies tells Contact which bodies have been one,
   * and begin_step() distributes their energy in proportion to what it finds.
   *
   * **Left out.** Faces that @p from does not have get no history, and faces that @p to does not
   * have lose theirs. Multipliers of the augmented Lagrangian stay empty, because motions do not use
   * them. The last search stays empty, so that the next detect() searches for candidate pairs anew.
   *
   * **New faces.** The faces of the new piece of a crack begin without pressure. What the solid has
   * transmitted there is not a part of contact; in motion TimeIntegrator::continue_after_cut()
   * lets it fade.
   *
   * **Limits.** A face must not be longer in @p to than in @p from within one edge, as the end of
   * the old face would be continued by extrapolation. The new piece of a crack is a curve of its own
   * (extend_crack()), and edges end where curves do. Edges as short as the rounding of their ends
   * have no direction and may be assigned to the edge next to them.
   *
   * Obstacles must be the same in both. The displacements of both surfaces are not used. All ranks
   * hold all edges and the whole history, so that every rank gets the same result, without
   * communication.
   * Cost: O((n + m) log (n + m)) for n edges and m places, if each edge has few common pieces.
   * @throws InputError if the obstacles differ.
   */
  ContactHistory
  carry_history(const ContactHistory            &history,
                const ContactSurface            &from,
                const ContactSurface            &to,
                const std::vector<unsigned int> &slave_priority = {});
} // namespace NMM

#endif
