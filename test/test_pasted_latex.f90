module test_pasted_latex
    !! Statements that are pasted from LaTeX.
    use funit, only: TestMethod, TestSuite
    use lagrangia_judgement, only: is_right, is_unreadable, is_wrong
    use tried_responses, only: judged
    implicit none (type, external)
    private
    public :: pasted_latex_suite

    character, parameter :: line_feed = new_line("a")

contains

    function pasted_latex_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("pasted_latex")
        call suite%addTest(TestMethod("statements_in_latex", &
                                      statements_in_latex))
    end function pasted_latex_suite

    subroutine statements_in_latex()
        !! As in textbooks and in lecture notes.
        call judged("pendulum", &
                    "\ddot{\theta} + \frac{g}{l}\sin\theta = 0", is_right)
        call judged("pendulum", &
                    "ml^2\ddot\theta + mgl\sin\theta = 0", is_right)
        call judged("pendulum", &
                    "\ddot{\theta} = -\frac{g}{\ell}\sin(\theta)", is_right)
        call judged("pendulum", &
                    "\frac{d}{dt}\frac{\partial L}{\partial\dot\theta} = ml^2\ddot\theta", is_right)
        call judged("pendulum", &
                    "\frac{d}{dt}\left(\frac{\partial L}{\partial"// &
                    " \dot{\theta}}\right) - \frac{\partial L}{\partial \theta} = 0", is_right)
        call judged("pendulum", &
                    "\frac{d^2\theta}{dt^2} = -\frac gl \sin\theta", is_right)
        call judged("pendulum", "\frac{d \cos\theta}{dt} = -\dot\theta\sin\theta", is_right)
        call judged("pendulum", "\frac{d m l^2 \dot\theta}{dt} = -m g l \sin\theta", is_right)
        call judged("pendulum", "\frac{d m l^2 \dot\theta}{dt} = -m g \sin\theta", is_wrong)
        call judged("pendulum", "\omega^2 = g l^-1", is_right)
        call judged("pendulum", &
                    "\frac{\mathrm{d}^2 \theta}{\mathrm{d}t^2} + \frac{g}{l} \sin"// &
                    " \theta = 0", is_right)
        call judged("pendulum", &
                    "L = \frac{1}{2} m l^2 \dot{\theta}^2 + m g l \cos\theta", is_right)
        call judged("pendulum", &
                    "L = \frac12 ml^2\dot\theta^2 - mgl\left(1-\cos\theta\right),", is_right)
        call judged("pendulum", &
                    "E = \frac{m}{2}\ell^2\dot\theta^2 - mg\ell\cos\theta = \text{const}", is_right)
        call judged("pendulum", &
                    "E = \frac{m}{2}\ell^2\dot\theta^2 + mg\ell\cos\theta", is_wrong)
        call judged("pendulum", &
                    "\ddot{\theta} - \frac{g}{l}\sin\theta = 0", is_wrong)
        call judged("pendulum", &
                    "\omega = \sqrt{\frac{g}{l}}", is_right)
        call judged("pendulum", &
                    "T = 2\pi\sqrt{l/g}", is_right)
        call judged("pendulum", &
                    "p_\theta = ml^2\dot\theta", is_right)
        call judged("pendulum", &
                    "\dot p_\theta = -mgl\sin\theta", is_right)
        call judged("pendulum", &
                    "\dot{p}_{\theta} = -mgl\sin\theta", is_right)
        call judged("pendulum", &
                    "\frac{\partial^2 V}{\partial\theta^2} = mgl\cos\theta", is_right)
        call judged("pendulum", &
                    "$\ddot\theta = -\omega_0^2 \sin\theta$"//line_feed//"$\omeg"// &
                    "a_0^2 = g/l$", is_right)
        call judged("pendulum", &
                    "\ddot\theta &= -\frac{g}{l}\sin\theta \\", is_right)
        call judged("pendulum", &
                    "\sin\theta \approx \theta", is_right)
        call judged("pendulum", &
                    "v^2 = l^2\dot\theta^2", is_right)
        call judged("pendulum", &
                    "\frac{d\theta}{dt} = \frac{p_\theta}{ml^2}", is_right)
        call judged("pendulum", &
                    "\sin^2\theta + \cos^2\theta = 1", is_right)
        call judged("pendulum", &
                    "\sin 2\theta = 2\sin\theta\cos\theta", is_right)
        call judged("pendulum", &
                    "\frac{dE}{dt} = 0", is_right)
        call judged("pendulum", &
                    "\dot{\theta}\ddot{\theta}+\frac{g}{l}\dot\theta\sin{\theta}=0", is_right)
        call judged("pendulum", &
                    "\cos^2{\theta}=1-\sin^2{\theta}", is_right)
        call judged("pendulum", &
                    "V(\theta)=mgl(1-\cos\theta)", is_right)
        call judged("pendulum", &
                    "T=\tfrac12 ml^2\dot\theta^2", is_right)
        call judged("pendulum", &
                    "\vec{F} = m\vec{a}", is_unreadable)
        call judged("pendulum", &
                    "\theta'' = -\frac{g}{l}\sin\theta", is_right)
        call judged("pendulum", &
                    "L(\theta,\dot\theta) = \frac{m}{2}l^2\dot\theta^2+mgl\cos\theta", is_right)
        call judged("pendulum", &
                    "S = mg\cos\theta + ml\dot\theta^2", is_right)
        call judged("double_pendulum", &
                    "(m_1+m_2)l_1\ddot\theta_1 + m_2l_2\ddot\theta_2\cos(\theta_"// &
                    "1-\theta_2) + m_2l_2\dot\theta_2^2\sin(\theta_1-\theta_2) +"// &
                    " (m_1+m_2)g\sin\theta_1 = 0", is_right)
        call judged("double_pendulum", &
                    "l_2\ddot{\theta}_2 + l_1\ddot{\theta}_1\cos(\theta_1-\theta"// &
                    "_2) - l_1\dot{\theta}_1^2\sin(\theta_1-\theta_2) +"// &
                    " g\sin{\theta_2} = 0", is_right)
        call judged("double_pendulum", &
                    "l_2\ddot{\theta}_2 + l_1\ddot{\theta}_1\cos(\theta_1-\theta"// &
                    "_2) + l_1\dot{\theta}_1^2\sin(\theta_1-\theta_2) +"// &
                    " g\sin{\theta_2} = 0", is_wrong)
        call judged("double_pendulum", &
                    "p_{\theta_1} = (m_1+m_2)l_1^2\dot\theta_1+m_2l_1l_2\dot\the"// &
                    "ta_2\cos\left(\theta_1-\theta_2\right)", is_right)
        call judged("double_pendulum", &
                    "V = -(m_1+m_2)gl_1\cos\theta_1-m_2gl_2\cos\theta_2", is_right)
        call judged("double_pendulum", &
                    "\frac{\partial L}{\partial\dot\theta_2} ="// &
                    " m_2l_2^2\dot\theta_2+m_2l_1l_2\dot\theta_1\cos(\theta_1-\theta_2)", is_right)
        call judged("double_pendulum", &
                    "\frac{\partial^2V}{\partial\theta_1\partial\theta_2} = 0", is_right)
        call judged("cart_pendulum", &
                    "(m_1+m_2)\ddot x + m_2l\ddot\theta\cos\theta -"// &
                    " m_2l\dot\theta^2\sin\theta = 0", is_right)
        call judged("pendulum", "\vec{F} = m g", is_unreadable, &
                    "column 1: '\vec' is a vector; write its components, x_dot and y_dot")
        call judged("pendulum", "\frac{g}{l = 0", is_unreadable, &
                    "column 9: the group is not closed; write '}'")
        call judged("pendulum", "m \foo = 0", is_unreadable, &
                    "column 3: '\foo' is not read; write it in plain letters, as theta_ddot "// &
                    "or sqrt(g/l)")
        call judged("pendulum", "m \pm 1 = 0", is_unreadable, &
                    "column 3: '\pm' has two meanings; write a statement with + and one with -")
        call judged("pendulum", "\sqrt[3]{m} = 1", is_unreadable, &
                    "column 1: '\sqrt[n]' is not read; write (x)^(1/3)")
        call judged("pendulum", "\dot{(m l)} = 1", is_unreadable, &
                    "column 1: dots stand on one letter; write d/dt(...) for what is in braces")
        call judged("pendulum", repeat("{", 99)//"\theta"//repeat("}", 99)//" = \theta", is_right)
        call judged("pendulum", repeat("{", 100)//"\theta"//repeat("}", 100)//" = \theta", &
                    is_unreadable, "column 101: more than 100 groups within each other; give "// &
                                   "parts of it names")
    end subroutine statements_in_latex
end module test_pasted_latex
