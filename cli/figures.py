"""The figures of the paper: which function draws each, with which file of conf/figure/."""

# name: (file of conf/figure/, function that returns the figure and its claims)
FIGURES = {
    "fig1": ("fig1", "cli.fig1_runs.fig1"),
    "fig2": ("fig2", "cli.fig2_runs.fig2"),
    "fig3a": ("fig3", "imitation.analysis.fig3a.fig3a"),
    "fig3b": ("fig3", "imitation.analysis.fig3b.fig3b"),
    "fig4": ("fig4", "cli.figure_runs.fig4"),
    "fig5": ("fig5", "cli.figure_runs.fig5"),
    "fig6": ("fig6", "cli.fig6_runs.fig6"),
    "fig7": ("fig7", "cli.fig7_runs.fig7"),
}
