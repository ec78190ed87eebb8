// Runs axe-core on the page that it stands on, laid out WIDTH px wide, and tells the console
// "said: done FINDINGS RULES" with rule and place of each finding; what is wider than the page is one, too.
addEventListener('load', async () => {
  document.documentElement.style.width = window.WIDTH + 'px';
  const answer = await axe.run(document, { resultTypes: ['violations'] });
  const findings = answer.violations.map(v => v.id + ' at ' + v.nodes.map(n => n.target.join(' ')).join(', '));
  const scrolls = node => node && (getComputedStyle(node).overflowX === 'auto' || scrolls(node.parentElement));
  for (const node of document.querySelectorAll('body *'))
    if (node.getBoundingClientRect().right > window.WIDTH + 1 && !scrolls(node)) {
      findings.push('wider than the page: ' + node.tagName + ' ' + node.textContent.slice(0, 40));
      break;
    }
  const rules = answer.passes.length + answer.violations.length;
  console.log(['said: done', findings.length, rules, ...findings].join(' '));
});
