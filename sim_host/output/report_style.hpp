// How a report page looks. No '<', '>' or '&' in it: the page's writer would escape them.
#pragma once

namespace palpate::sim {

inline constexpr const char* kReportStyle = R"css(
:root { color-scheme: light; --ink: #1c2229; --soft: #5d6874; --rule: #d9dee3; --tint: #f3f6f9; --link: #0a5b94; }
* { box-sizing: border-box; }
body { counter-reset: table figure; margin: 0 auto; padding: 3.5rem 2rem 5rem; max-width: 66rem; background: #ffffff; color: var(--ink);
  font: 1.06rem/1.6 Charter, 'Bitstream Charter', 'Source Serif 4', Cambria, Georgia, 'Liberation Serif', serif; }
h1 { margin: 0 0 .7rem; font-size: 2.3rem; line-height: 1.15; font-weight: 600; letter-spacing: -.01em; }
h2 { margin: 3.6rem 0 1rem; padding-top: 1.1rem; border-top: 1px solid var(--rule); font-size: 1.45rem;
  line-height: 1.25; font-weight: 600; }
p { margin: 0 0 1rem; max-width: 42rem; }
.summary { font-size: 1.2rem; line-height: 1.5; color: var(--soft); }
a { color: var(--link); text-decoration: none; }
a:hover { text-decoration: underline; }
nav, .legend, table, figcaption { font-family: 'Source Sans 3', 'Helvetica Neue', Helvetica, Arial,
  'Liberation Sans', sans-serif; }
nav { margin: 1.8rem 0 0; font-size: .95rem; }
nav ol { display: flex; flex-wrap: wrap; gap: .2rem 1.8rem; margin: 0; padding: 0; list-style: none; }
.legend { display: flex; flex-wrap: wrap; gap: .2rem 1.6rem; max-width: none; margin: 1.1rem 0 0;
  font-size: .86rem; color: var(--soft); }
.wide { overflow-x: auto; margin: 1.5rem 0 1.9rem; }
table { border-collapse: collapse; font-size: .93rem; line-height: 1.35; font-variant-numeric: tabular-nums lining-nums; }
caption { caption-side: top; padding: 0 0 .55rem; text-align: left; color: var(--soft); }
caption::before { counter-increment: table; content: 'Table ' counter(table) '. '; font-weight: 600; color: var(--ink); }
thead th { padding: .45rem .6rem .4rem; border-top: 2px solid var(--ink); border-bottom: 1px solid var(--ink);
  text-align: left; vertical-align: bottom; font-weight: 600; }
td { padding: .34rem .6rem; border-bottom: 1px solid var(--rule); text-align: left; vertical-align: top; }
tbody tr:last-child td { border-bottom: 2px solid var(--ink); }
thead th.number, td.number { text-align: right; white-space: nowrap; }
.paper { color: var(--soft); font-style: italic; }
.ours { font-weight: 600; }
td.ours { background: var(--tint); }
.holds, .goal-met { color: #1a6b3a; }
.fails { color: #a8261c; font-weight: 600; }
td.fails { background: #fdf0ee; }
.goal-missed { color: #8a5a00; }
td.goal-missed { background: #fdf7ea; }
.sign { display: inline-block; width: 1.15em; margin-left: .3em; text-align: center; font-style: normal; }
.figures { display: flex; flex-wrap: wrap; gap: 1.6rem 2rem; align-items: flex-start; margin: 1.6rem 0 2rem; }
figure { flex: 1 1 24rem; min-width: 0; max-width: 58rem; margin: 0; }
figure img { display: block; width: 100%; height: auto; }
figcaption { margin-top: .6rem; font-size: .9rem; line-height: 1.45; color: var(--soft); }
figcaption::before { counter-increment: figure; content: 'Figure ' counter(figure) '. '; font-weight: 600;
  color: var(--ink); }
@media print { body { padding: 0; max-width: none; font-size: 10pt; } nav { display: none; }
  figure, table { break-inside: avoid; } h2 { break-after: avoid; } }
)css";

}  // namespace palpate::sim
