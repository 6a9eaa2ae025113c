import {openOtherSite} from '../studio.mjs';

export const title = 'the page shows the building, and is for nobody else';

export async function run({page, context, studio, check, picture}) {
  const answer = await page.goto(studio.address);
  check(answer.status() === 200, 'the address that is printed leads to the page');
  await page.locator('canvas').first().waitFor();
  await page.getByRole('tab', {name: 'Buildings'}).click();
  await page.getByText('house', {exact: true}).first().waitFor();
  check(true, 'the building has its name');
  await picture('page');

  const stranger = await page.request.get(`${studio.origin}/`, {failOnStatusCode: false});
  check(stranger.status() === 403, 'without the token there is no page');

  // A page of another site that even knows the token.
  const site = await openOtherSite('<!doctype html><title>another site</title>');
  const other = await context.newPage();
  await other.goto(site.address);
  const said = await other.evaluate(([address, token]) => {
    const form = new Blob(['{}'], {type: 'text/plain'});
    return Promise.all([
      fetch(address, {method: 'POST', mode: 'no-cors', body: form}).then(reply => reply.type, () => 'failed'),
      fetch(address, {method: 'POST', headers: {'X-Oriel-Token': token, 'Content-Type': 'application/json'}, body: '{}'})
        .then(reply => reply.status, () => 'failed')
    ]);
  }, [`${studio.origin}/api/state`, studio.token]);
  site.close();
  check(said[1] === 'failed', 'another site cannot ask');
  check(/refused: method=POST path=\/api\/state status=403/.test(studio.log), 'what it sent is refused and a line of the log');
  check(/refused: method=OPTIONS path=\/api\/state status=403/.test(studio.log), 'its browser was not allowed to ask');
}
