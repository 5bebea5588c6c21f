submodule (lagrangia_charged_particle) lagrangia_charged_particle_description
    !! What the charged particle says of itself.
    use lagrangia_description, only: conserved, coordinate, nonnegative, number, point, positive, &
                                     quantity, quantity_t, vector
    implicit none (type, external)

contains

    pure module subroutine describe(self, d)
        !! See `system_t`.
        class(charged_particle_t), intent(in) :: self
        type(description_t), intent(out) :: d
        real(dp), parameter :: per_speed = 1.0_dp  !! m/s: free, the particle has no natural speed
        integer :: i

        d%name = "charged_particle"
        d%title = "a charge in uniform electric and magnetic fields, free or in a trap"
        d%coordinates = [coordinate("x", "m", "position, from the centre of the trap"), &
                         coordinate("y", "m", "position, from the centre of the trap"), &
                         coordinate("z", "m", "position, from the centre of the trap")]
        d%parameters = [positive("m", "kg", "mass", self%m), &
                        number("charge", "C", "charge, e, of either sign", self%charge), &
                        vector("electric", "V/m", "electric field, E", self%electric), &
                        vector("magnetic", "T", "magnetic field, B", self%magnetic), &
                        nonnegative("trap", "N/m", "spring constant of an isotropic trap", &
                                    self%trap)]
        d%energy_scale = self%m*per_speed**2
        d%quantities = [ &
            quantity("pseudo_x", "kg m/s", "(m v + e B x r - e E t)_x: conserved without a trap"), &
            quantity("pseudo_y", "kg m/s", "(m v + e B x r - e E t)_y: conserved without a trap"), &
            quantity("pseudo_z", "kg m/s", "(m v + e B x r - e E t)_z: conserved without a trap"), &
            quantity("L_axis", "kg m^2/s", "n.(s x m v) + e |B| s_perp^2/2, s = r - e E/trap "// &
                     "(or r), n along B: see the notes"), &
            conserved("energy_axis", "J", "m/2 v_n^2 - e E_n r_n + trap/2 r_n^2: of the motion "// &
                      "along B (n)", d%energy_scale), &
            quantity("speed", "m/s", "|v|: conserved without electric field and trap"), &
            quantity("p_x", "kg m/s", "(m v + e A)_x: canonical momentum, depends on the gauge"), &
            quantity("p_y", "kg m/s", "(m v + e A)_y: canonical momentum, depends on the gauge"), &
            quantity("p_z", "kg m/s", "(m v + e A)_z: canonical momentum, depends on the gauge")]
        if (self%trap <= 0.0_dp) then
            d%quantities(1:3)%conserved = .true.
            d%quantities(6)%conserved = length(self%charge*self%electric) <= 0.0_dp
            do i = 1, 3
                d%quantities(6 + i)%conserved = self%is_cyclic(i)
            end do
        end if
        d%quantities(4)%conserved = self%trap > 0.0_dp .or. self%parallel()
        d%quantities(:3)%scale = self%m*per_speed
        d%quantities(6:)%scale = self%m*per_speed
        d%quantities(6)%scale = per_speed
        d%points = [point("particle", self%m)]
        d%reactions = [quantity_t ::]
        d%dimensions = 3
        d%lagrangian = [character(len(d%title)) :: &
            "m/2 v.v + e E.r + e A.v - trap/2 r.r,   A = B x r/2 (symmetric gauge)"]
        d%energy = "m/2 v.v - e E.r + trap/2 r.r"
        d%equations = [character(len(d%title)) :: "m v_dot = e (E + v x B) - trap r"]
        d%constraint = "none: three free coordinates"
        d%notes = [character(len(d%title)) :: &
            "The notes have F = - grad(phi) for B = 0: a slip, e is missing: - e grad(phi).", &
            "General: L = m/2 v.v - e phi + e A.v; here phi = - E.r. B does no work.", &
            "Any gauge, one motion: m v + e A depends on it, m v + e B x r - e E t does not.", &
            "Free: drift E x B/B^2, turning at omega_c = e B/m, falling freely along B.", &
            "L_axis is conserved in a trap; without one where E is parallel to B or zero.", &
            "Trap, E = 0: omega = sqrt(omega0^2 + omega_c^2/4) +- omega_c/2 across B, "// &
            "omega0 along it."]
        d%source = "Phys 601, 1 September 2011: velocity-dependent generalized potentials"
    end subroutine describe
end submodule lagrangia_charged_particle_description
