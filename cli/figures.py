"""The figures of the paper: which function draws each, with which file of conf/figure/."""

# name: (file of conf/figure/, function that returns the figure and its claims)
FIGURES = {
    "fig3a": ("fig3", "imitation.analysis.fig3.fig3a"),
    "fig3b": ("fig3", "imitation.analysis.fig3.fig3b"),
}
