// SPDX-License-Identifier: Apache-2.0
// Defines riisWindkessel, a boundary condition for the pressure at an outlet: the vessels behind it, as two resistances and a
// compliance.
//
//   p = p_c + Rp Q,   C dp_c/dt = Q - (p_c - p_v) / Rd
//
// Q is the flow out of the domain through the patch, and p_c is the pressure of the compliance C. Rp and Rd are the proximal and
// distal resistances, and p_v is the pressure behind them. p_c advances by backward Euler. Each pressure equation of a step uses
// the latest Q, and begins with p_c of the last step. On faces through which blood flows back, p is the total pressure, because a
// static pressure lets returning blood gain speed without bounds.
#include "addToRunTimeSelectionTable.H"
#include "fixedValueFvPatchFields.H"
#include "riisValve.H"
#include "surfaceFields.H"
#include "volFields.H"

namespace Foam {

class riisWindkesselFvPatchScalarField : public fixedValueFvPatchScalarField {
  word phi_, U_;
  scalar rho_, proximal_, distal_, compliance_, venous_;
  scalar stored_, before_;  // p_c now and at the end of the last step, Pa
  label timeIndex_;

 public:
  TypeName("riisWindkessel");

  riisWindkesselFvPatchScalarField(const fvPatch &patch, const DimensionedField<scalar, volMesh> &field)
      : fixedValueFvPatchScalarField(patch, field),
        phi_("phi"),
        U_("U"),
        rho_(1),
        proximal_(0),
        distal_(1),
        compliance_(1),
        venous_(0),
        stored_(0),
        before_(0),
        timeIndex_(-1) {}

  riisWindkesselFvPatchScalarField(const fvPatch &patch, const DimensionedField<scalar, volMesh> &field,
                                   const dictionary &dict)
      : fixedValueFvPatchScalarField(patch, field, dict, false),
        phi_(dict.getOrDefault<word>("phi", "phi")),
        U_(dict.getOrDefault<word>("U", "U")),
        rho_(fv::positive(dict, "rho")),
        proximal_(fv::positive(dict, "proximalResistance")),
        distal_(fv::positive(dict, "distalResistance")),
        compliance_(fv::positive(dict, "compliance")),
        venous_(dict.getOrDefault<scalar>("venousPressure", 0)),
        stored_(dict.get<scalar>("pressure")),
        before_(stored_),
        timeIndex_(-1) {
    fv::refuseOthers(dict, {"type", "patchType", "value", "phi", "U", "rho", "proximalResistance", "distalResistance",
                            "compliance", "venousPressure", "pressure"});
    if (dict.found("value")) {
      fvPatchScalarField::operator=(scalarField("value", dict, patch.size()));
    } else {
      fvPatchScalarField::operator=(stored_ / unit());
    }
  }

  riisWindkesselFvPatchScalarField(const riisWindkesselFvPatchScalarField &from, const fvPatch &patch,
                                   const DimensionedField<scalar, volMesh> &field, const fvPatchFieldMapper &mapper)
      : fixedValueFvPatchScalarField(from, patch, field, mapper) {
    copy(from);
  }

  riisWindkesselFvPatchScalarField(const riisWindkesselFvPatchScalarField &from,
                                   const DimensionedField<scalar, volMesh> &field)
      : fixedValueFvPatchScalarField(from, field) {
    copy(from);
  }

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
    const Time &time = db().time();
    if (timeIndex_ != time.timeIndex()) {
      timeIndex_ = time.timeIndex();
      before_ = stored_;
    }
    const scalarField &phi = patch().lookupPatchField<surfaceScalarField, scalar>(phi_);
    const vectorField &U = patch().lookupPatchField<volVectorField, vector>(U_);
    const scalar flow = gSum(phi), dt = time.deltaTValue();
    stored_ = (before_ + dt / compliance_ * (flow + venous_ / distal_)) / (1 + dt / (compliance_ * distal_));
    operator==((stored_ + proximal_ * flow - 0.5 * rho_ * neg(phi) * magSqr(U)) / unit());
    fixedValueFvPatchScalarField::updateCoeffs();
  }

  // Writes the pressure with all digits, so that a restart continues with the same bits.
  void write(Ostream &os) const override {
    fvPatchScalarField::write(os);
    const int digits = os.precision(17);
    os.writeEntryIfDifferent<word>("phi", "phi", phi_);
    os.writeEntryIfDifferent<word>("U", "U", U_);
    os.writeEntry("rho", rho_);
    os.writeEntry("proximalResistance", proximal_);
    os.writeEntry("distalResistance", distal_);
    os.writeEntry("compliance", compliance_);
    os.writeEntry("venousPressure", venous_);
    os.writeEntry("pressure", stored_);
    os.precision(digits);
    writeEntry("value", os);
  }

 private:
  // Returns the pressure in Pa of a unit of the field, which is kinematic or not.
  scalar unit() const { return internalField().dimensions() == dimPressure ? 1 : rho_; }
  void copy(const riisWindkesselFvPatchScalarField &from) {
    phi_ = from.phi_;
    U_ = from.U_;
    rho_ = from.rho_;
    proximal_ = from.proximal_;
    distal_ = from.distal_;
    compliance_ = from.compliance_;
    venous_ = from.venous_;
    stored_ = from.stored_;
    before_ = from.before_;
    timeIndex_ = from.timeIndex_;
  }
};

makePatchTypeField(fvPatchScalarField, riisWindkesselFvPatchScalarField);

}  // namespace Foam
