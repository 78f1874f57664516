// SPDX-License-Identifier: Apache-2.0
// Defines riisWindkessel, a boundary condition for the pressure at an outlet. The condition models the vessels behind the outlet
// by two resistances and a compliance.
//
//   p = p_c + Rp Q,   C dp_c/dt = Q - (p_c - p_v) / Rd
//
// Q is the flow out of the domain through the patch, and p_c is the pressure of the compliance C. Rp and Rd are the proximal and
// the distal resistance, and p_v is the pressure behind both. p_c advances by backward Euler. Each pressure equation of a step
// uses the latest Q, and starts from p_c of the last step. At a face with backflow, p is the total pressure. With a static
// pressure, returning blood would gain speed without bounds.
#include "addToRunTimeSelectionTable.H"
#include "fixedValueFvPatchFields.H"
#include "riisValve.H"
#include "surfaceFields.H"
#include "volFields.H"

namespace Foam {

class riisWindkesselFvPatchScalarField : public fixedValueFvPatchScalarField {
  struct Vessels {
    word phi{"phi"}, U{"U"};
    scalar rho = 1, proximal = 0, distal = 1, compliance = 1, venous = 0;
    scalar stored = 0, before = 0;  // p_c now and at the end of the last step, Pa
    label timeIndex = -1;
  } vessels_;

 public:
  TypeName("riisWindkessel");

  riisWindkesselFvPatchScalarField(const fvPatch &patch, const DimensionedField<scalar, volMesh> &field)
      : fixedValueFvPatchScalarField(patch, field) {}

  riisWindkesselFvPatchScalarField(const fvPatch &patch, const DimensionedField<scalar, volMesh> &field,
                                   const dictionary &dict)
      : fixedValueFvPatchScalarField(patch, field, dict, false) {
    vessels_.phi = dict.getOrDefault<word>("phi", vessels_.phi);
    vessels_.U = dict.getOrDefault<word>("U", vessels_.U);
    vessels_.rho = fv::positive(dict, "rho");
    vessels_.proximal = fv::positive(dict, "proximalResistance");
    vessels_.distal = fv::positive(dict, "distalResistance");
    vessels_.compliance = fv::positive(dict, "compliance");
    vessels_.venous = dict.getOrDefault<scalar>("venousPressure", vessels_.venous);
    vessels_.stored = vessels_.before = dict.get<scalar>("pressure");
    fv::refuseOthers(dict, {"type", "patchType", "value", "phi", "U", "rho", "proximalResistance", "distalResistance",
                            "compliance", "venousPressure", "pressure"});
    if (dict.found("value")) {
      fvPatchScalarField::operator=(scalarField("value", dict, patch.size()));
    } else {
      fvPatchScalarField::operator=(vessels_.stored / unit());
    }
  }

  riisWindkesselFvPatchScalarField(const riisWindkesselFvPatchScalarField &from, const fvPatch &patch,
                                   const DimensionedField<scalar, volMesh> &field, const fvPatchFieldMapper &mapper)
      : fixedValueFvPatchScalarField(from, patch, field, mapper), vessels_(from.vessels_) {}

  riisWindkesselFvPatchScalarField(const riisWindkesselFvPatchScalarField &from,
                                   const DimensionedField<scalar, volMesh> &field)
      : fixedValueFvPatchScalarField(from, field), vessels_(from.vessels_) {}

  riisWindkesselFvPatchScalarField(const riisWindkesselFvPatchScalarField &from)
      : riisWindkesselFvPatchScalarField(from, from.internalField()) {}

  tmp<fvPatchScalarField> clone() const override {
    return tmp<fvPatchScalarField>(new riisWindkesselFvPatchScalarField(*this));
  }
  tmp<fvPatchScalarField> clone(const DimensionedField<scalar, volMesh> &field) const override {
    return tmp<fvPatchScalarField>(new riisWindkesselFvPatchScalarField(*this, field));
  }

  void updateCoeffs() override {
    if (updated()) return;
    Vessels &now = vessels_;
    const Time &time = db().time();
    if (now.timeIndex != time.timeIndex()) {
      now.timeIndex = time.timeIndex();
      now.before = now.stored;
    }
    const scalarField &phi = patch().lookupPatchField<surfaceScalarField, scalar>(now.phi);
    const vectorField &U = patch().lookupPatchField<volVectorField, vector>(now.U);
    const scalar flow = gSum(phi), dt = time.deltaTValue();
    now.stored = (now.before + dt / now.compliance * (flow + now.venous / now.distal)) /
                 (1 + dt / (now.compliance * now.distal));
    operator==((now.stored + now.proximal * flow - 0.5 * now.rho * neg(phi) * magSqr(U)) / unit());
    fixedValueFvPatchScalarField::updateCoeffs();
  }

  // Writes the pressure with all digits, so that a restart has the same bits.
  void write(Ostream &os) const override {
    fvPatchScalarField::write(os);
    const int digits = os.precision(17);
    os.writeEntryIfDifferent<word>("phi", "phi", vessels_.phi);
    os.writeEntryIfDifferent<word>("U", "U", vessels_.U);
    os.writeEntry("rho", vessels_.rho);
    os.writeEntry("proximalResistance", vessels_.proximal);
    os.writeEntry("distalResistance", vessels_.distal);
    os.writeEntry("compliance", vessels_.compliance);
    os.writeEntry("venousPressure", vessels_.venous);
    os.writeEntry("pressure", vessels_.stored);
    os.precision(digits);
    writeEntry("value", os);
  }

 private:
  // Returns the pressure in Pa that one unit of the field stands for. The field may be kinematic.
  scalar unit() const { return internalField().dimensions() == dimPressure ? 1 : vessels_.rho; }
};

makePatchTypeField(fvPatchScalarField, riisWindkesselFvPatchScalarField);

}  // namespace Foam
