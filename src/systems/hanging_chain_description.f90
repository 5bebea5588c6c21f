submodule (lagrangia_hanging_chain) lagrangia_hanging_chain_description
    !! What a hanging chain says of itself.
    use lagrangia_description, only: conserved, coordinate, count_of, nonnegative, point, &
                                     positive, quantity
    use lagrangia_text, only: to_text
    implicit none (type, external)

contains

    pure module subroutine describe(self, d)
        class(hanging_chain_t), intent(in) :: self
        type(description_t), intent(out) :: d
        integer :: k

        d%name = "hanging_chain"
        d%title = "equal bobs on equal rods, a chain that hangs; n = 1, 2: the pendulums"
        d%coordinates = [(coordinate("theta"//to_text(k), "rad", "angle of rod "//to_text(k)// &
                                     " from the downward vertical"), k=1, self%n)]
        d%parameters = [count_of("n", "number of bobs", self%n, most), &
                        positive("m", "kg", "mass of each bob", self%m), &
                        positive("l", "m", "length of the whole chain, each rod l/n", self%l), &
                        nonnegative("g", "m/s^2", "gravity", self%g)]
        d%energy_scale = 0.5_dp*(self%n + 1)*self%m*self%g*self%l
        d%quantities = [ &
            quantity("L_z", "kg m^2/s", "sum of m (x y_dot - y x_dot): angular momentum about "// &
                     "the pivot"), &
            quantity("tension1", "N", "of the uppermost rod")]
        if (self%g <= 0.0_dp) d%quantities(1) = &
            conserved("L_z", "kg m^2/s", "sum of m (x y_dot - y x_dot): angular momentum about "// &
                      "the pivot, conserved without gravity", 0.0_dp)
        d%points = [(point("bob"//to_text(k), self%m), k=1, self%n)]
        d%reactions = [(quantity("tension"//to_text(k), "N", "of rod "//to_text(k)// &
                                 ": (l/n - (r_k - r_(k-1))^2 n/l)/2 = 0"), k=1, self%n)]
        d%lagrangian = [character(len(d%title)) :: &
            "sum over k of m/2 (x_k_dot^2 + y_k_dot^2) - m g y_k", &
            "x_k = l/n sum over i <= k of sin(theta_i), y_k = -l/n sum of cos(theta_i)"]
        d%energy = "sum over k of m/2 (x_k_dot^2 + y_k_dot^2) + m g y_k"
        d%equations = [character(len(d%title)) :: &
            "m l/n theta_k_ddot = T_(k+1) sin(theta_(k+1) - theta_k)", &
            "    - T_(k-1) sin(theta_k - theta_(k-1)),  k > 1", &
            "m l/n theta_1_ddot = T_2 sin(theta_2 - theta_1) - m g sin(theta_1)", &
            "2 T_k - T_(k+1) cos(theta_(k+1) - theta_k) - T_(k-1) cos(theta_k - theta_(k-1))", &
            "    = m l/n theta_k_dot^2,  k > 1,  T_(n+1) = 0", &
            "T_1 - T_2 cos(theta_2 - theta_1) = m l/n theta_1_dot^2 + m g cos(theta_1)"]
        d%constraint = "holonomic, scleronomic: (x_k - x_(k-1))^2 + (y_k - y_(k-1))^2 = (l/n)^2"
        d%notes = [character(len(d%title)) :: &
            "omega^2 = n g/l times the zeros of Laguerre's polynomial L_n.", &
            "As n grows omega goes to j0,k/2 sqrt(g/l), j0,k the zeros of Bessel's J_0."]
        d%source = "Phys 601, 1 September 2011: double planar pendulum, continued"
    end subroutine describe
end submodule lagrangia_hanging_chain_description
